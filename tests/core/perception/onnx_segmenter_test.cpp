// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/onnx_segmenter.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/perception/class_names.hpp"

namespace occusg {
namespace {

/// The models and what they answer: tests/data/make_segmentation_models.py.
std::string model(const std::string& name) {
  return OCCUSG_TEST_DATA "/segmentation/" + name + ".onnx";
}

OnnxSegmenterConfig configOf(const std::string& path) {
  OnnxSegmenterConfig config;
  config.model_path = path;
  config.class_names = {"chair", "table", "lamp"};
  return config;
}

std::string refusal(const OnnxSegmenterConfig& config) {
  try {
    OnnxSegmenter segmenter(config);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// What the sentence says after the path.
std::string refusalOf(const std::string& name) {
  const std::string sentence = refusal(configOf(model(name)));
  const std::string path = model(name) + ": ";
  return sentence.rfind(path, 0) == 0 ? sentence.substr(path.size()) : "no path: " + sentence;
}

/// 128 x 96: red left of x = 40, blue from x = 64 above y = 48, black elsewhere. The models see it
/// at half the size, 8 rows further down.
cv::Mat picture() {
  cv::Mat image(96, 128, CV_8UC3, cv::Scalar::all(0));
  image.colRange(0, 40).setTo(cv::Scalar(0, 0, 255));
  image(cv::Rect(64, 0, 64, 48)).setTo(cv::Scalar(255, 0, 0));
  return image;
}

/// That the mask is set in `expected`, given in the image, and nowhere else.
void expectPixels(const InstanceMask& mask, const cv::Rect& expected) {
  cv::Mat whole(96, 128, CV_8UC1, cv::Scalar(0));
  mask.pixels.copyTo(whole(mask.box));
  EXPECT_EQ(cv::boundingRect(whole), expected);
  EXPECT_EQ(cv::countNonZero(whole), expected.area());
}

struct Expected {
  std::string class_name;
  int class_id;
  double score;
  cv::Rect box;
  cv::Rect pixels;
};

void expectMasks(const InstanceMasks& result, const std::vector<Expected>& expected) {
  EXPECT_EQ(result.image_size, cv::Size(128, 96));
  EXPECT_EQ(result.refused.total(), 0U);
  ASSERT_EQ(result.masks.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE("mask " + std::to_string(i));
    EXPECT_EQ(result.masks[i].class_name, expected[i].class_name);
    EXPECT_EQ(result.masks[i].class_id, expected[i].class_id);
    EXPECT_NEAR(result.masks[i].score, expected[i].score, 1e-6);
    EXPECT_EQ(result.masks[i].box, expected[i].box);
    expectPixels(result.masks[i], expected[i].pixels);
  }
}

// Input (x, y) is image (2 x, 2 (y - 8)). The lamp is blue above y = 48, the chair red left of 40.
const Expected kLamp = {"lamp", 2, 0.95, {80, 32, 32, 32}, {80, 32, 32, 16}};
const Expected kChair = {"chair", 0, 0.90, {16, 16, 48, 64}, {16, 16, 24, 64}};

TEST(OnnxSegmenter, ReadsTheLayoutWithAnchors) {
  OnnxSegmenter segmenter(configOf(model("anchors")));
  expectMasks(segmenter.segment(picture()),
              {kLamp,
               kChair,
               {"table", 1, 0.75, {16, 16, 48, 64}, {16, 16, 48, 64}},
               {"chair", 0, 0.72, {36, 16, 48, 64}, {36, 16, 48, 64}}});
}

TEST(OnnxSegmenter, ReadsTheEndToEndLayout) {
  OnnxSegmenter segmenter(configOf(model("end_to_end")));
  expectMasks(segmenter.segment(picture()),
              {kLamp,
               kChair,
               {"", 7, 0.85, {16, 16, 48, 64}, {16, 16, 48, 64}},
               {"chair", 0, 0.80, {18, 16, 48, 64}, {18, 16, 48, 64}}});
}

TEST(OnnxSegmenter, OutputsMayComeInEitherOrder) {
  OnnxSegmenter segmenter(configOf(model("prototypes_first")));
  const InstanceMasks result = segmenter.segment(picture());
  ASSERT_EQ(result.masks.size(), 4U);
  EXPECT_EQ(result.masks[0].class_name, "lamp");
}

TEST(OnnxSegmenter, ModelThatTakesAnySizeGetsTheConfiguredOne) {
  OnnxSegmenterConfig config = configOf(model("any_size"));
  config.input_side = 128;
  OnnxSegmenter segmenter(config);
  const InstanceMasks result = segmenter.segment(picture());
  ASSERT_EQ(result.masks.size(), 4U);
  // Input (x, y) is now image (x, y - 16).
  EXPECT_EQ(result.masks[0].box, cv::Rect(40, 8, 16, 16));
  EXPECT_EQ(result.masks[1].box, cv::Rect(8, 0, 24, 32));
}

TEST(OnnxSegmenter, ConfiguredSizeDoesNotTouchAModelOfFixedSize) {
  OnnxSegmenterConfig config = configOf(model("anchors"));
  config.input_side = 1280;
  OnnxSegmenter segmenter(config);
  EXPECT_EQ(segmenter.segment(picture()).masks.at(0).box, kLamp.box);
}

TEST(OnnxSegmenter, MinimumConfidenceAndOverlapAreConfigurable) {
  OnnxSegmenterConfig config = configOf(model("anchors"));
  config.min_confidence = 0.6;
  config.max_iou = 1.0;
  EXPECT_EQ(OnnxSegmenter(config).segment(picture()).masks.size(), 6U);
  config.max_iou = 0.3;
  EXPECT_EQ(OnnxSegmenter(config).segment(picture()).masks.size(), 4U)
      << "the chairs at 0.80 and 0.72 go, the one at 0.69 comes";
}

TEST(OnnxSegmenter, SameImageGivesTheSameMasks) {
  OnnxSegmenter segmenter(configOf(model("anchors")));
  const InstanceMasks first = segmenter.segment(picture());
  (void)segmenter.segment(cv::Mat(300, 200, CV_8UC3, cv::Scalar(1, 2, 3)));
  const InstanceMasks again = segmenter.segment(picture());
  ASSERT_EQ(first.masks.size(), again.masks.size());
  for (std::size_t i = 0; i < first.masks.size(); ++i)
    EXPECT_EQ(cv::countNonZero(first.masks[i].pixels != again.masks[i].pixels), 0);
}

TEST(OnnxSegmenter, UnknownLayerIsNamed) {
  const std::string sentence = refusalOf("unknown_layer");
  EXPECT_NE(sentence.find("OpenCV " + cv::getVersionString() + " cannot use it"), std::string::npos)
      << sentence;
  EXPECT_NE(sentence.find("NoSuchOperator"), std::string::npos) << sentence;
  // Before 4.6 OpenCV tells a layer by its first output, not by its name.
  const bool is_told = sentence.find("/model/odd") != std::string::npos ||
                       sentence.find("output0") != std::string::npos;
  EXPECT_TRUE(is_told) << sentence;
  EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
}

TEST(OnnxSegmenter, OtherInputsAndOutputsAreNamed) {
  EXPECT_EQ(refusalOf("one_output"),
            "has 1 outputs (output1); predictions and prototypes of a segmentation model are "
            "needed");
  EXPECT_EQ(refusalOf("two_images"), "has 2 inputs (images, depth); one image is needed");
  EXPECT_EQ(refusalOf("grey_input"),
            "input images is 1 x 1 x 64 x 64; 1 x 3 x height x width with sides in [32, 4096] is "
            "needed");
  EXPECT_EQ(refusalOf("odd_shape"),
            "predictions 1 x 7 x 9 do not fit prototypes 1 x 32 x 16 x 16; 1 x (4 + classes + 32 "
            "coefficients) x anchors, 1 x anchors x (5 + classes + 32 coefficients) or 1 x rows x "
            "(6 + 32 coefficients) is needed");
}

TEST(OnnxSegmenter, AnotherNumberOfNamesIsRefused) {
  OnnxSegmenterConfig config = configOf(model("anchors"));
  config.class_names.pop_back();
  EXPECT_EQ(refusal(config), model("anchors") +
                                 ": predictions 1 x 39 x 84 are of 3 classes; the list of names "
                                 "has 2");
}

TEST(OnnxSegmenter, MissingFileAndOtherFilesAreRefused) {
  EXPECT_EQ(refusal(configOf("nowhere.onnx")),
            "nowhere.onnx: is not a file; an ONNX segmentation model is needed");
  const std::string text = OCCUSG_TEST_DATA "/segmentation/classes.txt";
  EXPECT_EQ(refusal(configOf(text)), text +
                                         ": is not an ONNX model, or cut short; a model is "
                                         "needed");
}

TEST(OnnxSegmenter, ModelCutShortAnywhereIsRefused) {
  std::ifstream whole(model("anchors"), std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(whole)),
                          std::istreambuf_iterator<char>());
  ASSERT_GT(bytes.size(), 1000U);
  const std::string path = ::testing::TempDir() + "occusg_cut_short.onnx";
  for (std::size_t size = 0; size < bytes.size(); size += 97) {
    std::ofstream(path, std::ios::binary) << bytes.substr(0, size);
    EXPECT_NE(refusal(configOf(path)), "") << "at " << size << " bytes";
  }
  std::filesystem::remove(path);
}

TEST(OnnxSegmenter, RefusesSettingsOutOfRange) {
  const auto changed = [](auto change) {
    OnnxSegmenterConfig config = configOf(model("anchors"));
    change(config);
    return refusal(config);
  };
  using Config = OnnxSegmenterConfig;
  EXPECT_EQ(changed([](Config& c) { c.input_side = 31; }),
            "perception.model.input_side: is 31; allowed is [32, 4096]");
  EXPECT_NE(changed([](Config& c) { c.input_side = 4097; }), "");
  EXPECT_EQ(changed([](Config& c) { c.min_confidence = 0.0; }),
            "perception.model.min_confidence: is 0; allowed is [0.001, 1]");
  EXPECT_NE(changed([](Config& c) { c.min_confidence = std::numeric_limits<double>::quiet_NaN(); }),
            "");
  EXPECT_EQ(changed([](Config& c) { c.max_iou = 1.5; }),
            "perception.model.max_iou: is 1.5; allowed is [0, 1]");
  EXPECT_EQ(changed([](Config& c) { c.class_names.clear(); }),
            "class_names: is empty; the names of the model's classes are needed");
}

TEST(OnnxSegmenter, RefusesImagesOfOtherTypes) {
  OnnxSegmenter segmenter(configOf(model("anchors")));
  EXPECT_THROW((void)segmenter.segment(cv::Mat()), Error);
  EXPECT_THROW((void)segmenter.segment(cv::Mat(8, 8, CV_8UC1, cv::Scalar(0))), Error);
  EXPECT_THROW((void)segmenter.segment(cv::Mat(8, 8, CV_32FC3, cv::Scalar(0))), Error);
}

}  // namespace
}  // namespace occusg
