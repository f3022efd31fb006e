// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/onnx_segmenter.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn/dnn.hpp>
#include <system_error>
#include <utility>

#include "occusg/error.hpp"
#include "occusg/perception/camera_model.hpp"
#include "perception/letterbox.hpp"
#include "perception/onnx_signature.hpp"
#include "perception/yolo_output.hpp"

namespace occusg {
namespace {

/// More than the largest model of the family has; OpenCV's reader ends at 2 GiB.
constexpr std::uintmax_t kMaxModelBytes = std::uintmax_t{1} << 30U;
constexpr int kMinInputSide = 32;
constexpr int kMaxInputSide = 4096;

/// OpenCV prints what it also throws; the core does not print.
class SilencedOpenCv {
 public:
  SilencedOpenCv()
      : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~SilencedOpenCv() { cv::utils::logging::setLogLevel(level_); }
  SilencedOpenCv(const SilencedOpenCv&) = delete;
  SilencedOpenCv(SilencedOpenCv&&) = delete;
  SilencedOpenCv& operator=(const SilencedOpenCv&) = delete;
  SilencedOpenCv& operator=(SilencedOpenCv&&) = delete;

 private:
  cv::utils::logging::LogLevel level_;
};

void check(const OnnxSegmenterConfig& config) {
  if (config.class_names.empty())
    throw refuse("class_names", "is empty", "the names of the model's classes are needed");
  (void)checked(config);
}

std::string readModel(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed))
    throw refuse(path, "is not a file", "an ONNX segmentation model is needed");
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  if (failed || size > kMaxModelBytes)
    throw refuse(path, "is longer than 1 GiB", "an ONNX model with its weights inside is needed");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!file) throw refuse(path, "cannot be read", "a readable file is needed");
  return bytes;
}

std::string namesOf(const std::vector<OnnxTensor>& tensors) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(tensors.size(), kShown); ++i)
    text += (i > 0 ? ", " : "") + tensors[i].name;
  return text + (tensors.size() > kShown ? ", ..." : "");
}

std::string shapeText(const std::vector<std::int64_t>& shape) {
  std::string text;
  for (std::size_t i = 0; i < shape.size(); ++i)
    text += (i > 0 ? " x " : "") + (shape[i] == 0 ? "?" : std::to_string(shape[i]));
  return text.empty() ? "of no known shape" : text;
}

void check(const OnnxSignature& signature, const std::string& path) {
  if (signature.inputs.size() != 1) {
    throw refuse(path,
                 "has " + std::to_string(signature.inputs.size()) + " inputs (" +
                     namesOf(signature.inputs) + ")",
                 "one image is needed");
  }
  if (signature.outputs.size() != 2) {
    throw refuse(path,
                 "has " + std::to_string(signature.outputs.size()) + " outputs (" +
                     namesOf(signature.outputs) + ")",
                 "predictions and prototypes of a segmentation model are needed");
  }
}

/// The size of the image the model takes; `open_side` where it leaves it open.
cv::Size inputSize(const OnnxTensor& input, int open_side, const std::string& path) {
  const std::vector<std::int64_t>& shape = input.shape;
  if (shape.empty()) return {open_side, open_side};
  const auto fits = [](std::int64_t value, std::int64_t least, std::int64_t most) {
    return value == 0 || (value >= least && value <= most);
  };
  if (shape.size() != 4 || !fits(shape[0], 1, 1) || !fits(shape[1], 3, 3) ||
      !fits(shape[2], kMinInputSide, kMaxInputSide) ||
      !fits(shape[3], kMinInputSide, kMaxInputSide)) {
    throw refuse(path, "input " + input.name + " is " + shapeText(shape),
                 "1 x 3 x height x width with sides in [32, 4096] is needed");
  }
  return {shape[3] == 0 ? open_side : static_cast<int>(shape[3]),
          shape[2] == 0 ? open_side : static_cast<int>(shape[2])};
}

/// OpenCV's message on one line, of a length one reads.
std::string reason(const cv::Exception& error) {
  constexpr std::size_t kLongest = 300;
  std::string text;
  for (const char c : error.err) {
    const bool is_space = static_cast<unsigned char>(c) <= 0x20U;
    if (!is_space) text += c;
    if (is_space && !text.empty() && text.back() != ' ') text += ' ';
  }
  if (text.rfind("> ", 0) == 0) text.erase(0, 2);
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

Error unusable(const std::string& path, const cv::Exception& error) {
  return refuse(
      path, "OpenCV " + cv::getVersionString() + " cannot use it: " + reason(error),
      "a YOLOv5 segmentation model of opset 12 works with OpenCV 4.2 and newer; YOLOv8 and "
      "YOLO11 need a newer OpenCV");
}

}  // namespace

/// The loaded model: image in, two tensors out.
class OnnxSegmenter::Network {
 public:
  Network(const std::string& path, int open_side) : path_(path) {
    const std::string bytes = readModel(path);
    const auto signature = readOnnxSignature(bytes);
    if (!signature) throw refuse(path, "is not an ONNX model, or cut short", "a model is needed");
    check(*signature, path);
    input_ = inputSize(signature->inputs.front(), open_side, path);
    try {
      const SilencedOpenCv silenced;
      network_ = cv::dnn::readNetFromONNX(bytes.data(), bytes.size());
      network_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
      network_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    } catch (const cv::Exception& error) {
      throw unusable(path, error);
    }
  }

  struct Output {
    cv::Mat predictions;
    cv::Mat prototypes;
  };

  Output run(const cv::Mat& input) {
    std::vector<cv::Mat> outputs;
    try {
      const SilencedOpenCv silenced;
      network_.setInput(input);
      network_.forward(outputs, network_.getUnconnectedOutLayersNames());
    } catch (const cv::Exception& error) {
      throw unusable(path_, error);
    }
    if (outputs.size() != 2) {
      throw refuse(path_, "gives " + std::to_string(outputs.size()) + " outputs",
                   "predictions and prototypes of a segmentation model are needed");
    }
    // Exporters order them as they like; the number of dimensions tells them apart.
    if (outputs[0].dims > outputs[1].dims) std::swap(outputs[0], outputs[1]);
    return {outputs[0], outputs[1]};
  }

  [[nodiscard]] const cv::Size& input() const { return input_; }

  YoloLayout layout = YoloLayout::kAnchors;

 private:
  std::string path_;
  cv::Size input_;
  cv::dnn::Net network_;
};

OnnxSegmenter::OnnxSegmenter(const OnnxSegmenterConfig& config) : config_(config) {
  check(config_);
  network_ = std::make_unique<Network>(config_.model_path, config_.input_side);
  const cv::Size size = network_->input();
  const cv::Mat grey(size, CV_8UC3, cv::Scalar::all(128));
  const auto output = network_->run(networkInput(grey, fitLetterbox(size, size)));
  network_->layout = layoutOf(output.predictions, output.prototypes, config_.class_names.size(),
                              config_.model_path);
}

OnnxSegmenter::~OnnxSegmenter() = default;

InstanceMasks OnnxSegmenter::segment(const cv::Mat& image) {
  if (image.empty() || image.type() != CV_8UC3 || image.cols > kMaxImageSide ||
      image.rows > kMaxImageSide) {
    throw refuse(
        "colour image",
        "is " + std::to_string(image.cols) + " x " + std::to_string(image.rows) +
            " pixels of OpenCV type " + std::to_string(image.type()),
        "an image of CV_8UC3 with sides in [1, " + std::to_string(kMaxImageSide) + "] is needed");
  }
  const Letterbox letterbox = fitLetterbox(image.size(), network_->input());
  const auto output = network_->run(networkInput(image, letterbox));
  const YoloInstances found =
      decodeYolo(output.predictions, output.prototypes.size[1],
                 {network_->layout, config_.min_confidence, config_.max_iou});

  InstanceMasks result;
  result.image_size = image.size();
  result.refused = found.refused;
  for (const YoloInstance& instance : found.instances) {
    InstanceMask mask = maskInImage(instance, output.prototypes, letterbox);
    mask.class_id = instance.class_id;
    const auto index = static_cast<std::size_t>(instance.class_id);
    if (instance.class_id >= 0 && index < config_.class_names.size())
      mask.class_name = config_.class_names[index];
    result.masks.push_back(std::move(mask));
  }
  return result;
}

}  // namespace occusg
