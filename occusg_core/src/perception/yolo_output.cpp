// SPDX-License-Identifier: BSD-3-Clause
#include "perception/yolo_output.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/dnn/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr int kBoxRows = 4;            ///< Centre x, y, width, height.
constexpr int kObjectnessColumns = 5;  ///< Centre x, y, width, height, any object.
constexpr int kEndToEndColumns = 6;    ///< Two corners, score, class.
/// End-to-end models give a few hundred instances, the others thousands of anchors.
constexpr int kMaxEndToEndRows = 1000;
constexpr std::size_t kMaxCandidates = 3000;

/// "1 x 38 x 8400"
std::string shapeOf(const cv::Mat& tensor) {
  std::string text;
  for (int i = 0; i < tensor.dims; ++i)
    text += (i > 0 ? " x " : "") + std::to_string(tensor.size[i]);
  return text;
}

bool isTensor(const cv::Mat& tensor, int dimensions) {
  return tensor.type() == CV_32FC1 && tensor.dims == dimensions && tensor.size[0] == 1 &&
         tensor.total() > 0 && tensor.isContinuous();
}

/// The 3D tensor 1 x rows x columns as a matrix on the same memory.
cv::Mat matrixOf(const cv::Mat& tensor) { return tensor.reshape(1, tensor.size[1]); }

bool isFinite(const YoloInstance& instance) {
  const cv::Rect2d& box = instance.box;
  return std::isfinite(instance.score) && std::isfinite(box.x) && std::isfinite(box.y) &&
         std::isfinite(box.width) && std::isfinite(box.height) &&
         cv::checkRange(instance.coefficients);
}

/// Takes a candidate of the network unless it is not finite or has no area.
void take(const YoloInstance& candidate, int position, YoloInstances& result) {
  const std::string where = "prediction " + std::to_string(position);
  if (!isFinite(candidate)) {
    result.refused.add(MaskRefusal::kBadNumber, [&] {
      return where + ": holds NaN or infinity; all numbers must be finite";
    });
  } else if (candidate.box.width <= 0.0 || candidate.box.height <= 0.0) {
    result.refused.add(MaskRefusal::kEmpty, [&] {
      return where + ": its box is " + std::to_string(candidate.box.width) + " x " +
             std::to_string(candidate.box.height) + "; both sides must be positive";
    });
  } else {
    result.instances.push_back(candidate);
  }
}

/// Best class of an anchor; a NaN among the scores wins, so that it is noticed.
struct BestClass {
  int id = 0;
  float score = -1.0F;
};

/// Goes through the scores as they lie in memory: an anchor's are a whole row apart.
std::vector<BestClass> bestClasses(const cv::Mat& predictions, int class_count) {
  std::vector<BestClass> best(static_cast<std::size_t>(predictions.cols));
  for (int id = 0; id < class_count; ++id) {
    const auto* scores = predictions.ptr<float>(kBoxRows + id);
    for (std::size_t anchor = 0; anchor < best.size(); ++anchor) {
      if (!(scores[anchor] <= best[anchor].score) && !std::isnan(best[anchor].score))
        best[anchor] = {id, scores[anchor]};
    }
  }
  return best;
}

YoloInstances anchorCandidates(const cv::Mat& predictions, int coefficient_count,
                               float min_confidence) {
  const int class_count = predictions.rows - kBoxRows - coefficient_count;
  const std::vector<BestClass> best = bestClasses(predictions, class_count);
  YoloInstances result;
  for (int anchor = 0; anchor < predictions.cols; ++anchor) {
    const BestClass& top = best[static_cast<std::size_t>(anchor)];
    if (top.score < min_confidence) continue;
    YoloInstance candidate;
    const double width = predictions.at<float>(2, anchor);
    const double height = predictions.at<float>(3, anchor);
    candidate.box = {predictions.at<float>(0, anchor) - width / 2.0,
                     predictions.at<float>(1, anchor) - height / 2.0, width, height};
    candidate.class_id = top.id;
    candidate.score = top.score;
    candidate.coefficients =
        predictions.col(anchor).rowRange(kBoxRows + class_count, predictions.rows).t();
    take(candidate, anchor, result);
  }
  return result;
}

/// The best class given that there is an object; a NaN among the scores wins.
BestClass bestClassOf(const float* scores, int class_count) {
  BestClass best;
  for (int id = 0; id < class_count && !std::isnan(best.score); ++id)
    if (!(scores[id] <= best.score)) best = {id, scores[id]};
  return best;
}

YoloInstances objectnessCandidates(const cv::Mat& predictions, int coefficient_count,
                                   float min_confidence) {
  const int class_count = predictions.cols - kObjectnessColumns - coefficient_count;
  YoloInstances result;
  for (int row = 0; row < predictions.rows; ++row) {
    const auto* values = predictions.ptr<float>(row);
    const float objectness = values[kBoxRows];
    if (objectness < min_confidence) continue;
    const BestClass top = bestClassOf(values + kObjectnessColumns, class_count);
    YoloInstance candidate;
    candidate.score = objectness * top.score;
    if (candidate.score < min_confidence) continue;
    candidate.class_id = top.id;
    candidate.box = {values[0] - values[2] / 2.0, values[1] - values[3] / 2.0, values[2],
                     values[3]};
    candidate.coefficients =
        predictions.row(row).colRange(kObjectnessColumns + class_count, predictions.cols).clone();
    take(candidate, row, result);
  }
  return result;
}

/// The class of a row, which comes as a float; -1 when it is no class number.
int classIn(float value) {
  constexpr float kMost = 1e6F;
  return value >= 0.0F && value <= kMost ? static_cast<int>(std::lround(value)) : -1;
}

YoloInstances endToEndInstances(const cv::Mat& predictions, float min_confidence) {
  YoloInstances result;
  for (int row = 0; row < predictions.rows; ++row) {
    const auto* values = predictions.ptr<float>(row);
    if (values[4] < min_confidence) continue;
    YoloInstance instance;
    instance.box = {values[0], values[1], static_cast<double>(values[2]) - values[0],
                    static_cast<double>(values[3]) - values[1]};
    instance.score = values[4];
    instance.class_id = classIn(values[5]);
    instance.coefficients =
        predictions.row(row).colRange(kEndToEndColumns, predictions.cols).clone();
    take(instance, row, result);
  }
  return result;
}

YoloInstances candidatesOf(const cv::Mat& predictions, int coefficient_count, YoloLayout layout,
                           float min_confidence) {
  switch (layout) {
    case YoloLayout::kAnchors:
      return anchorCandidates(predictions, coefficient_count, min_confidence);
    case YoloLayout::kAnchorsWithObjectness:
      return objectnessCandidates(predictions, coefficient_count, min_confidence);
    case YoloLayout::kEndToEnd:
      break;
  }
  return endToEndInstances(predictions, min_confidence);
}

void sortByScore(std::vector<YoloInstance>& instances) {
  std::stable_sort(instances.begin(), instances.end(),
                   [](const YoloInstance& a, const YoloInstance& b) { return a.score > b.score; });
}

void keepFirst(std::size_t limit, YoloInstances& found) {
  const std::size_t count = found.instances.size();
  if (count <= limit) return;
  found.refused.add(
      MaskRefusal::kOverLimit,
      [&] {
        return "model: found " + std::to_string(count) + " instances; the best " +
               std::to_string(limit) + " are taken";
      },
      count - limit);
  found.instances.resize(limit);
}

/// Non-maximum suppression within each class. @pre sorted by score.
void suppressOverlaps(std::vector<YoloInstance>& instances, double max_iou) {
  std::map<int, std::vector<std::size_t>> of_class;
  for (std::size_t i = 0; i < instances.size(); ++i) of_class[instances[i].class_id].push_back(i);
  std::vector<std::size_t> kept;
  for (const auto& [class_id, members] : of_class) {
    std::vector<cv::Rect2d> boxes;
    std::vector<float> scores;
    for (const std::size_t i : members) {
      boxes.push_back(instances[i].box);
      scores.push_back(instances[i].score);
    }
    std::vector<int> best;
    cv::dnn::NMSBoxes(boxes, scores, 0.0F, static_cast<float>(max_iou), best);
    for (const int i : best) kept.push_back(members[static_cast<std::size_t>(i)]);
  }
  std::sort(kept.begin(), kept.end());
  std::vector<YoloInstance> result;
  result.reserve(kept.size());
  for (const std::size_t i : kept) result.push_back(instances[i]);
  instances = std::move(result);
}

}  // namespace

YoloLayout layoutOf(const cv::Mat& predictions, const cv::Mat& prototypes, std::size_t class_count,
                    const std::string& where) {
  if (!isTensor(predictions, 3) || !isTensor(prototypes, 4)) {
    throw refuse(where, "gives outputs " + shapeOf(predictions) + " and " + shapeOf(prototypes),
                 "predictions of 3 dimensions and prototypes of 4, floats of a single image, are "
                 "needed: is it a segmentation model?");
  }
  const int coefficients = prototypes.size[1];
  const int rows = predictions.size[1];
  const int columns = predictions.size[2];
  const int classes = rows - kBoxRows - coefficients;
  if (classes > 0 && static_cast<std::size_t>(classes) == class_count) return YoloLayout::kAnchors;
  const int classes_in_columns = columns - kObjectnessColumns - coefficients;
  // With a single class both layouts have as many columns.
  const bool is_end_to_end =
      columns == kEndToEndColumns + coefficients && (class_count > 1 || rows <= kMaxEndToEndRows);
  if (is_end_to_end) return YoloLayout::kEndToEnd;
  if (classes_in_columns > 0 && static_cast<std::size_t>(classes_in_columns) == class_count)
    return YoloLayout::kAnchorsWithObjectness;
  if (classes > 0 && columns > rows) {
    throw refuse(
        where,
        "predictions " + shapeOf(predictions) + " are of " + std::to_string(classes) + " classes",
        "the list of names has " + std::to_string(class_count));
  }
  if (classes_in_columns > 0 && rows > columns) {
    throw refuse(where,
                 "predictions " + shapeOf(predictions) + " are of " +
                     std::to_string(classes_in_columns) + " classes",
                 "the list of names has " + std::to_string(class_count));
  }
  const std::string end = std::to_string(coefficients) + " coefficients)";
  throw refuse(
      where,
      "predictions " + shapeOf(predictions) + " do not fit prototypes " + shapeOf(prototypes),
      "1 x (4 + classes + " + end + " x anchors, 1 x anchors x (5 + classes + " + end +
          " or 1 x rows x (6 + " + end + " is needed");
}

YoloInstances decodeYolo(const cv::Mat& predictions, int coefficient_count,
                         const YoloDecoding& decoding) {
  const cv::Mat matrix = matrixOf(predictions);
  // Compared as the network gives it: 0.7 as a float is a little less than as a double.
  const auto min_confidence = static_cast<float>(decoding.min_confidence);
  YoloInstances found = candidatesOf(matrix, coefficient_count, decoding.layout, min_confidence);
  sortByScore(found.instances);
  if (decoding.layout != YoloLayout::kEndToEnd) {
    keepFirst(kMaxCandidates, found);
    suppressOverlaps(found.instances, decoding.max_iou);
  }
  keepFirst(kMaxMasks, found);
  return found;
}

InstanceMask maskInImage(const YoloInstance& instance, const cv::Mat& prototypes,
                         const Letterbox& letterbox) {
  InstanceMask mask;
  mask.score = static_cast<double>(instance.score);
  mask.box = letterbox.toImage(instance.box);
  if (mask.box.empty()) return mask;

  const int height = prototypes.size[2];
  const int width = prototypes.size[3];
  const cv::Mat sum = instance.coefficients * prototypes.reshape(1, prototypes.size[1]);
  // From the centre of pixel (x, y) of the box to prototype coordinates, whose pixel centres are
  // whole numbers.
  const double to_x = static_cast<double>(width) / letterbox.input.width;
  const double to_y = static_cast<double>(height) / letterbox.input.height;
  const double step_x = letterbox.scaleX() * to_x;
  const double step_y = letterbox.scaleY() * to_y;
  const cv::Matx23d image_to_prototype(
      step_x, 0.0, (mask.box.x + 0.5) * step_x + letterbox.content.x * to_x - 0.5,  //
      0.0, step_y, (mask.box.y + 0.5) * step_y + letterbox.content.y * to_y - 0.5);
  cv::Mat enlarged;
  cv::warpAffine(sum.reshape(1, height), enlarged, image_to_prototype, mask.box.size(),
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  // The sigmoid is above 0.5 where its argument is above 0.
  mask.pixels = enlarged > 0.0;
  return mask;
}

}  // namespace occusg
