// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/sequence_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <locale>

#include "error_sentence.hpp"
#include "recorded_sequence.hpp"

namespace occusg {
namespace {

using testing::pngOf;
using testing::RecordedSequence;
using testing::sentenceOf;
using testing::tells;

std::string openingFails(const std::string& path) {
  return sentenceOf([&] { SequenceReader reader(path); });
}

std::string readingFails(const RecordedSequence& sequence, std::size_t index) {
  const SequenceReader reader(sequence.path());
  return sentenceOf([&] { (void)reader.read(index); });
}

TEST(SequenceReader, ReadsImagePoseCameraAndStamp) {
  const RecordedSequence sequence;
  const SequenceReader reader(sequence.path());
  ASSERT_EQ(reader.size(), 3U);
  EXPECT_EQ(reader.camera().width, 8);
  EXPECT_EQ(reader.camera().fy, 5.5);
  const Frame frame = reader.read(2);
  EXPECT_EQ(frame.stamp_s, 0.4);
  EXPECT_EQ(frame.depth.units_per_m, 5000.0);
  EXPECT_EQ(frame.depth.pixels.type(), CV_16UC1);
  EXPECT_EQ(frame.depth.pixels.at<std::uint16_t>(5, 7), 1002);
  EXPECT_EQ(frame.T_map_camera.translation(), Eigen::Vector3d(2, 0, 1));
  EXPECT_EQ(frame.camera.cx, 3.5);
  EXPECT_EQ(frame.depth_path, sequence.folder.at("depth/2.png"));
  EXPECT_FALSE(frame.color_path);
  EXPECT_FALSE(frame.label_path);
  EXPECT_FALSE(reader.truthPath());
  EXPECT_TRUE(reader.unusableLines().empty());
}

TEST(SequenceReader, ToleratesWindowsLineEndsBlankLinesCommentsAndNoFinalNewline) {
  const RecordedSequence sequence;
  sequence.folder.write("depth.txt", "# a\r\n\r\n  0.0\tdepth/0.png \r\n   # b\n\n0.2 depth/1.png");
  sequence.folder.write("groundtruth.txt", "0.0 5 0 1 0 0 0 1\r\n\r\n#\r\n0.2 6 0 1 0 0 0 1");
  const SequenceReader reader(sequence.path());
  ASSERT_EQ(reader.size(), 2U);
  EXPECT_EQ(reader.read(0).T_map_camera.translation().x(), 5.0);
  EXPECT_EQ(reader.read(1).T_map_camera.translation().x(), 6.0);
}

TEST(SequenceReader, ReadsQuaternionsInFileOrder) {
  const RecordedSequence sequence(1);
  const double half = std::sqrt(0.5);
  sequence.folder.write("groundtruth.txt", "0.0 0 0 0 0 0 " + std::to_string(half) + " " +
                                               std::to_string(half) + "\n");
  const Pose pose = SequenceReader(sequence.path()).read(0).T_map_camera;
  EXPECT_TRUE((pose * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, 1, 0), 1e-6));
  EXPECT_NEAR(pose.linear().determinant(), 1.0, 1e-12) << "must be normalised";
}

TEST(SequenceReader, NearestPoseWithinTheToleranceIsTaken) {
  const RecordedSequence sequence(1);
  sequence.folder.write("groundtruth.txt",
                        "0.019 9 0 1 0 0 0 1\n-0.005 7 0 1 0 0 0 1\n0.5 8 0 1 0 0 0 1\n");
  EXPECT_EQ(SequenceReader(sequence.path()).read(0).T_map_camera.translation().x(), 7.0);
}

TEST(SequenceReader, NoPoseNearEnoughSpoilsThatFrameOnly) {
  const RecordedSequence sequence;
  sequence.folder.write("groundtruth.txt", "0.0 0 0 1 0 0 0 1\n0.2301 5 0 1 0 0 0 1\n");
  EXPECT_TRUE(tells(readingFails(sequence, 1),
                    {"groundtruth.txt", "nearest to 0.2 s is at 0.2301 s", "within 0.02 s"}));
  EXPECT_EQ(SequenceReader(sequence.path(), {0.05}).read(1).stamp_s, 0.2);
  EXPECT_EQ(SequenceReader(sequence.path()).read(0).stamp_s, 0.0);
}

TEST(SequenceReader, TimeToleranceOutOfRangeIsRefused) {
  const RecordedSequence sequence;
  for (const double bad : {-0.1, 1.5, std::nan("")})
    EXPECT_TRUE(tells(sentenceOf([&] { SequenceReader reader(sequence.path(), {bad}); }),
                      {"max_time_offset_s", "from 0 to 1 s"}));
}

TEST(SequenceReader, BrokenPoseLinesSpoilTheirFramesOnly) {
  const std::string good = "0.0 0 0 1 0 0 0 1\n";
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"0.2 1 x 1 0 0 0 1", {":2", "ty is \"x\"", "finite number"}},
      {"0.2 1 0 nan 0 0 0 1", {":2", "tz is \"nan\"", "finite number"}},
      {"0.2 1 0 1 inf 0 0 1", {":2", "qx is \"inf\""}},
      {"0.2 1e999 0 1 0 0 0 1", {":2", "tx is \"1e999\""}},
      {"0.2 1 0 1 0 0 0 1.01", {":2", "norm 1.01", "1 within 0.001"}},
      {"0.2 1 0 1 0 0 0 0", {":2", "norm 0.0"}},
      {"0.2 1 0 1 0 0 0", {":2", "has 7 fields", "timestamp tx ty tz qx qy qz qw"}},
      {"0.2 1 0 1 0 0 0 1 9", {":2", "has 9 fields"}},
      {"0.2 " + std::string(5000, '1'), {":2", "longer than 1000 characters"}},
  };
  for (const auto& [line, parts] : cases) {
    SCOPED_TRACE(line.substr(0, 60));
    const RecordedSequence sequence;
    sequence.folder.write("groundtruth.txt", good + line + "\n0.4 2 0 1 0 0 0 1\n");
    EXPECT_TRUE(tells(readingFails(sequence, 1), parts));
    const SequenceReader reader(sequence.path());
    EXPECT_EQ(reader.read(2).T_map_camera.translation().x(), 2.0);
    ASSERT_EQ(reader.unusableLines().size(), 1U);
    EXPECT_TRUE(tells(reader.unusableLines()[0], parts));
  }
}

TEST(SequenceReader, AlmostUnitQuaternionIsNormalised) {
  const RecordedSequence sequence(1);
  sequence.folder.write("groundtruth.txt", "0.0 0 0 1 0 0 0 1.0009\n");
  const Pose pose = SequenceReader(sequence.path()).read(0).T_map_camera;
  EXPECT_TRUE(pose.linear().isApprox(Eigen::Matrix3d::Identity(), 1e-12));
}

TEST(SequenceReader, PoseLineWithoutReadableStampIsReported) {
  const RecordedSequence sequence(1);
  sequence.folder.write("groundtruth.txt", "0.0 0 0 1 0 0 0 1\nsoon 0 0 1 0 0 0 1\n");
  const SequenceReader reader(sequence.path());
  ASSERT_EQ(reader.unusableLines().size(), 1U);
  EXPECT_TRUE(tells(reader.unusableLines()[0], {"groundtruth.txt:2", "timestamp is \"soon\""}));
  EXPECT_EQ(reader.read(0).stamp_s, 0.0);
}

TEST(SequenceReader, BrokenDepthLinesSpoilTheirFramesOnly) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"0.2", {"depth.txt:2", "has 1 field;", "timestamp path"}},
      {"x depth/1.png", {"depth.txt:2", "timestamp is \"x\"", "finite number"}},
      {"-inf depth/1.png", {"depth.txt:2", "timestamp is \"-inf\""}},
      {"0.2 /etc/passwd", {"depth.txt:2", "\"/etc/passwd\" leaves the folder", "without \"..\""}},
      {"0.2 depth/../../x.png", {"depth.txt:2", "leaves the folder"}},
      {"0.2 " + std::string(2000, 'x'), {"depth.txt:2", "longer than 1000 characters"}},
      {std::string("0.2 de\0pth", 10), {"depth.txt:2", "control character"}},
      {"0.0 depth/1.png", {"depth.txt:2", "time goes back to 0.0 s after 0.0 s in line 1"}},
      {"-3.5 depth/1.png", {"depth.txt:2", "time goes back to -3.5 s after 0.0 s in line 1"}},
  };
  for (const auto& [line, parts] : cases) {
    SCOPED_TRACE(line.substr(0, 60));
    const RecordedSequence sequence;
    sequence.folder.write("depth.txt", "0.0 depth/0.png\n" + line + "\n0.4 depth/2.png\n");
    EXPECT_TRUE(tells(readingFails(sequence, 1), parts));
    const SequenceReader reader(sequence.path());
    ASSERT_EQ(reader.size(), 3U);
    EXPECT_EQ(reader.read(0).stamp_s, 0.0);
    EXPECT_EQ(reader.read(2).stamp_s, 0.4);
  }
}

TEST(SequenceReader, PathMayHoldSpaces) {
  const RecordedSequence sequence(1);
  sequence.folder.write("depth/my image.png", sequence.folder.read("depth/0.png"));
  sequence.folder.write("depth.txt", "0.0 depth/my image.png\n");
  EXPECT_EQ(SequenceReader(sequence.path()).read(0).depth.pixels.at<std::uint16_t>(0, 0), 1000);
}

TEST(SequenceReader, MissingImageSpoilsThatFrameOnly) {
  const RecordedSequence sequence;
  std::filesystem::remove(sequence.folder.at("depth/1.png"));
  EXPECT_TRUE(tells(readingFails(sequence, 1), {"depth/1.png: does not exist"}));
  EXPECT_EQ(SequenceReader(sequence.path()).read(2).stamp_s, 0.4);
}

TEST(SequenceReader, FolderInPlaceOfAnImageIsRefused) {
  const RecordedSequence sequence;
  std::filesystem::remove(sequence.folder.at("depth/1.png"));
  std::filesystem::create_directory(sequence.folder.at("depth/1.png"));
  EXPECT_TRUE(tells(readingFails(sequence, 1), {"depth/1.png: is not a regular file"}));
}

TEST(SequenceReader, ImageOfAnotherSizeOrTypeIsRefused) {
  const std::vector<std::pair<cv::Mat, std::vector<std::string>>> cases = {
      {cv::Mat(6, 9, CV_16UC1, cv::Scalar(1)), {"is 9 x 6 pixels", "the camera file says 8 x 6"}},
      {cv::Mat(6, 8, CV_8UC1, cv::Scalar(1)), {"8 bits and 1 channels", "16 bits and one"}},
      {cv::Mat(6, 8, CV_16UC3, cv::Scalar(1)), {"16 bits and 3 channels"}},
      {cv::Mat(6, 8, CV_16UC4, cv::Scalar(1)), {"16 bits and 4 channels"}},
  };
  for (const auto& [pixels, parts] : cases) {
    const RecordedSequence sequence;
    sequence.folder.write("depth/1.png", pngOf(pixels));
    EXPECT_TRUE(tells(readingFails(sequence, 1), parts));
    EXPECT_TRUE(tells(readingFails(sequence, 1), {"depth/1.png"}));
  }
}

TEST(SequenceReader, ImageTruncatedAnywhereIsRefused) {
  const RecordedSequence sequence;
  const std::string whole = sequence.folder.read("depth/1.png");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    SCOPED_TRACE(length);
    sequence.folder.write("depth/1.png", whole.substr(0, length));
    EXPECT_TRUE(tells(readingFails(sequence, 1), {"depth/1.png", "a complete PNG is needed"}));
  }
}

TEST(SequenceReader, CompleteImageWithoutPixelsIsRefused) {
  const RecordedSequence sequence;
  const std::string whole = sequence.folder.read("depth/1.png");
  constexpr std::size_t kHeaderEnd = 33;
  constexpr std::size_t kEndBytes = 12;
  sequence.folder.write("depth/1.png",
                        whole.substr(0, kHeaderEnd) + whole.substr(whole.size() - kEndBytes));
  EXPECT_TRUE(tells(readingFails(sequence, 1), {"depth/1.png: cannot be decoded"}));
}

TEST(SequenceReader, ColourAndLabelsAreFoundBesideTheDepth) {
  const RecordedSequence sequence;
  sequence.folder.write("labels/1.png", "x");
  sequence.folder.write("rooms.json", "{}");
  sequence.folder.write("rgb.txt",
                        "0.215 rgb/b.jpg\n0.19 rgb/a.jpg\n0.2 ../c.jpg\n0.2\nx rgb/d.jpg\n");
  const SequenceReader reader(sequence.path());
  EXPECT_EQ(reader.read(1).color_path, sequence.folder.at("rgb/a.jpg"));
  EXPECT_EQ(reader.read(1).label_path, sequence.folder.at("labels/1.png"));
  EXPECT_FALSE(reader.read(2).color_path);
  EXPECT_FALSE(reader.read(2).label_path);
  EXPECT_EQ(reader.truthPath(), sequence.folder.at("rooms.json"));
  ASSERT_EQ(reader.unusableLines().size(), 3U);
  EXPECT_TRUE(tells(reader.unusableLines()[0], {"rgb.txt:3", "leaves the folder"}));
  EXPECT_TRUE(tells(reader.unusableLines()[1], {"rgb.txt:4", "has 1 field;"}));
  EXPECT_TRUE(tells(reader.unusableLines()[2], {"rgb.txt:5", "timestamp is \"x\""}));
}

TEST(SequenceReader, SceneIsTheNameOfTheFolder) {
  const RecordedSequence sequence(1);
  const std::string name = std::filesystem::path(sequence.path()).filename().string();
  EXPECT_EQ(SequenceReader(sequence.path()).scene(), name);
  EXPECT_EQ(SequenceReader(sequence.path() + "/").scene(), name);
  EXPECT_EQ(SequenceReader(sequence.path() + "/depth/..").scene(), name);
}

TEST(SequenceReader, IndexBeyondTheEndIsRefused) {
  const RecordedSequence sequence;
  EXPECT_TRUE(tells(readingFails(sequence, 3), {"has no frame 3", "below 3"}));
}

TEST(SequenceReader, FolderThatIsNoneIsRefused) {
  const RecordedSequence sequence;
  EXPECT_TRUE(tells(openingFails(sequence.folder.at("gone")), {"gone", "is not a folder"}));
  EXPECT_TRUE(
      tells(openingFails(sequence.folder.at("depth.txt")), {"depth.txt", "is not a folder"}));
}

TEST(SequenceReader, MissingOrEmptyFilesAreRefusedOnOpening) {
  for (const char* name : {"depth.txt", "groundtruth.txt", "camera.json"}) {
    SCOPED_TRACE(name);
    const RecordedSequence sequence;
    std::filesystem::remove(sequence.folder.at(name));
    EXPECT_TRUE(tells(openingFails(sequence.path()), {name, "does not exist"}));
    sequence.folder.write(name, "");
    EXPECT_TRUE(tells(openingFails(sequence.path()), {name, "needed"}));
  }
}

TEST(SequenceReader, ListsOfCommentsAloneAreRefusedOnOpening) {
  const RecordedSequence sequence;
  sequence.folder.write("groundtruth.txt", "# nothing\n");
  EXPECT_TRUE(tells(openingFails(sequence.path()), {"groundtruth.txt", "holds no pose"}));
  sequence.folder.write("depth.txt", "# nothing\n");
  EXPECT_TRUE(tells(openingFails(sequence.path()), {"depth.txt", "lists no image"}));
}

TEST(SequenceReader, NoUsablePoseAtAllIsRefusedOnOpening) {
  const RecordedSequence sequence;
  sequence.folder.write("groundtruth.txt", "0.0 0 0 1 0 0 0 2\n0.2 0 0 1 0 0 0 2\n");
  EXPECT_TRUE(
      tells(openingFails(sequence.path()), {"groundtruth.txt:1", "norm 2.0", "no other line"}));
}

TEST(SequenceReader, TooManyLinesAreRefusedOnOpening) {
  const RecordedSequence sequence;
  sequence.folder.write("depth.txt", std::string(1'000'001, '\n'));
  EXPECT_TRUE(tells(openingFails(sequence.path()), {"depth.txt", "more than 1000000 lines"}));
}

TEST(SequenceReader, ReportsAtMostAHundredUnusableLines) {
  const RecordedSequence sequence;
  std::string poses = "0.0 0 0 1 0 0 0 1\n";
  for (int i = 0; i < 150; ++i) poses += "x\n";
  sequence.folder.write("groundtruth.txt", poses);
  EXPECT_EQ(SequenceReader(sequence.path()).unusableLines().size(), 100U);
}

TEST(SequenceReader, CameraThatIsNoneIsRefusedOnOpening) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {R"({"width": 8,)", {"camera.json:1", "not valid JSON"}},
      {"{\n\"width\": 8\n\"height\": 6}", {"camera.json:3", "not valid JSON"}},
      {"[]", {"camera.json", "an array of 0", "an object is needed"}},
      {R"({"width": 8})", {"camera.json", "has no \"height\""}},
      {R"({"width": "8", "height": 6})", {"width", "\"8\"", "integer"}},
      {R"({"width": 8.5, "height": 6})", {"width", "8.5", "integer"}},
      {R"({"width": 99999999999, "height": 6})", {"width", "99999999999", "integer"}},
      {R"({"width": -99999999999, "height": 6})", {"width", "-99999999999", "integer"}},
      {R"({"width": 8, "height": 6, "fx": null})", {"fx", "null", "finite number"}},
      {R"({"width": 8, "height": 6, "fx": 1e999})", {"camera.json", "not valid JSON"}},
      {R"({"width": 8, "height": 6, "fx": 0, "fy": 5, "cx": 3, "cy": 2, "depth_scale": 1})",
       {"camera.json", "fx"}},
      {R"({"width": 0, "height": 6, "fx": 5, "fy": 5, "cx": 3, "cy": 2, "depth_scale": 1})",
       {"camera.json", "width"}},
      {R"({"width": 8, "height": 6, "fx": 5, "fy": 5, "cx": 3, "cy": 2})",
       {"camera.json", "has no \"depth_scale\""}},
      {R"({"width": 8, "height": 6, "fx": 5, "fy": 5, "cx": 3, "cy": 2, "depth_scale": 0})",
       {"camera.json: depth_scale", "is 0.0", "above 0"}},
      {R"({"width": 8, "height": 6, "fx": 5, "fy": 5, "cx": 3, "cy": 2, "depth_scale": 1e7})",
       {"depth_scale", "at most 1e6"}},
  };
  for (const auto& [text, parts] : cases) {
    SCOPED_TRACE(text);
    const RecordedSequence sequence;
    sequence.folder.write("camera.json", text);
    EXPECT_TRUE(tells(openingFails(sequence.path()), parts));
  }
}

class CommaDecimals : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(SequenceReader, NumbersDoNotDependOnTheLocale) {
  const RecordedSequence sequence;
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaDecimals));
  const double stamp_s = SequenceReader(sequence.path()).read(1).stamp_s;
  std::locale::global(before);
  EXPECT_EQ(stamp_s, 0.2);
}

}  // namespace
}  // namespace occusg
