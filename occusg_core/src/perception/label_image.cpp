// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/perception/instance_mask.hpp"

namespace occusg {
namespace {

/// Keeps an image of many scattered objects from filling the memory.
constexpr std::int64_t kMaxMaskPixels = std::int64_t{1} << 26U;

/// An object in the image.
struct LabelledObject {
  int id = 0;
  int pixels = 0;
  cv::Rect box;
};

std::vector<LabelledObject> objectsIn(const cv::Mat& object_ids) {
  struct Extent {
    int pixels = 0;
    int min_x = 0, max_x = 0, min_y = 0, max_y = 0;
  };
  std::vector<Extent> extents(std::size_t{1} << 16U);
  for (int y = 0; y < object_ids.rows; ++y) {
    const auto* row = object_ids.ptr<std::uint16_t>(y);
    for (int x = 0; x < object_ids.cols; ++x) {
      Extent& extent = extents[row[x]];
      if (extent.pixels++ == 0) {
        extent.min_x = extent.max_x = x;
        extent.min_y = y;
      }
      extent.min_x = std::min(extent.min_x, x);
      extent.max_x = std::max(extent.max_x, x);
      extent.max_y = y;
    }
  }
  std::vector<LabelledObject> objects;
  for (std::size_t id = 1; id < extents.size(); ++id) {
    const Extent& e = extents[id];
    if (e.pixels == 0) continue;
    const cv::Rect box(e.min_x, e.min_y, e.max_x - e.min_x + 1, e.max_y - e.min_y + 1);
    objects.push_back({static_cast<int>(id), e.pixels, box});
  }
  return objects;
}

/// Drops the objects of the fewest pixels until the rest is within the limits.
void keepLargest(std::vector<LabelledObject>& objects, RefusedMasks& refused) {
  const std::size_t found = objects.size();
  std::stable_sort(
      objects.begin(), objects.end(),
      [](const LabelledObject& a, const LabelledObject& b) { return a.pixels > b.pixels; });
  if (objects.size() > kMaxMasks) objects.resize(kMaxMasks);
  std::int64_t mask_pixels = 0;
  const auto beyond =
      std::find_if(objects.begin(), objects.end(), [&](const LabelledObject& object) {
        mask_pixels += std::int64_t{object.box.width} * object.box.height;
        return mask_pixels > kMaxMaskPixels;
      });
  objects.erase(beyond, objects.end());
  std::sort(objects.begin(), objects.end(),
            [](const LabelledObject& a, const LabelledObject& b) { return a.id < b.id; });
  refused.add(
      MaskRefusal::kOverLimit,
      [&] {
        return "label image: holds " + std::to_string(found) + " objects; the largest " +
               std::to_string(objects.size()) + " are taken";
      },
      found - objects.size());
}

}  // namespace

InstanceMasks masksOf(const cv::Mat& object_ids,
                      const std::map<int, std::string>& label_of_object) {
  if (object_ids.empty() || object_ids.type() != CV_16UC1) {
    throw refuse("label image",
                 "is " + std::to_string(object_ids.cols) + " x " + std::to_string(object_ids.rows) +
                     " pixels of OpenCV type " + std::to_string(object_ids.type()),
                 "an image of CV_16UC1, one object id a pixel, is needed");
  }

  std::set<std::string> labels;
  for (const auto& [id, label] : label_of_object) labels.insert(label);

  InstanceMasks result;
  result.image_size = object_ids.size();
  std::vector<LabelledObject> objects = objectsIn(object_ids);
  keepLargest(objects, result.refused);
  for (const LabelledObject& object : objects) {
    InstanceMask mask;
    mask.source_object_id = object.id;
    mask.score = 1.0;
    mask.box = object.box;
    mask.pixels = object_ids(object.box) == object.id;
    const auto found = label_of_object.find(object.id);
    if (found != label_of_object.end()) {
      mask.class_name = found->second;
      mask.class_id = static_cast<int>(std::distance(labels.begin(), labels.find(found->second)));
    }
    result.masks.push_back(std::move(mask));
  }
  return result;
}

}  // namespace occusg
