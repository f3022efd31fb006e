// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "error_sentence.hpp"
#include "occusg/io/sequence_reader.hpp"
#include "recorded_sequence.hpp"

namespace occusg {
namespace {

using testing::pngOf;
using testing::RecordedSequence;
using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

/// Image `i` is 1000 + i everywhere, but for its first pixel, which is the highest value.
std::string depthPng(int i, int width = 8, int height = 6) {
  cv::Mat pixels(height, width, CV_16UC1, cv::Scalar(1000 + i));
  pixels.at<std::uint16_t>(0, 0) = 65535;
  return pngOf(pixels);
}

/// A camera at (i, 2, 3) m that looks along x of the map: its x is the map's -y, its y the map's
/// -z.
std::string matrixAt(int i, const char* line_end = "\n") {
  const std::string end = line_end;
  return "0 0 1 " + std::to_string(i) + end + "-1 0 0 2" + end + "0 -1 0 3" + end + "0 0 0 1" + end;
}

void expectCameraAt(const Frame& frame, double x) {
  EXPECT_TRUE(frame.T_map_camera.translation().isApprox(Eigen::Vector3d(x, 2, 3), 1e-6))
      << frame.T_map_camera.translation().transpose();
  EXPECT_TRUE(frame.T_map_camera.linear().col(2).isApprox(Eigen::Vector3d::UnitX(), 1e-6));
  EXPECT_TRUE(frame.T_map_camera.linear().col(1).isApprox(-Eigen::Vector3d::UnitZ(), 1e-6));
}

constexpr const char* kSmallCamera =
    R"({"width": 8, "height": 6, "fx": 5, "fy": 5.5, "cx": 3.5, "cy": 2.5, "depth_scale": 1000})";

TEST(RecordingLayouts, SevenScenesAsDownloaded) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    const std::string stem = "seq-01/frame-00000" + std::to_string(i);
    folder.write(stem + ".depth.png", depthPng(i, 640, 480));
    folder.write(stem + ".color.png", "not looked at");
    folder.write(stem + ".pose.txt", matrixAt(i, "\t\r\n"));
  }
  const SequenceReader reader(folder.at("seq-01"));
  EXPECT_EQ(reader.layout(), "7-Scenes");
  ASSERT_EQ(reader.size(), 3U);
  EXPECT_EQ(reader.camera().fx, 585.0);
  const Frame frame = reader.read(2);
  expectCameraAt(frame, 2);
  EXPECT_EQ(frame.depth.units_per_m, 1000.0);
  EXPECT_EQ(frame.depth.pixels.at<std::uint16_t>(1, 1), 1002);
  EXPECT_EQ(frame.depth.pixels.at<std::uint16_t>(0, 0), 0) << "the highest value is no return";
  EXPECT_EQ(frame.color_path, folder.at("seq-01/frame-000002.color.png"));
  EXPECT_TRUE(tells(reader.assumptions().at(0), {"7-Scenes", "585", "--camera"}));
  EXPECT_TRUE(tells(reader.assumptions().at(1), {"no stamps", "30 a second"}));
  // Its parent is not a recording, and says which folders are.
  EXPECT_TRUE(tells(sentenceOf([&] { SequenceReader scene(folder.path()); }),
                    {"holds recordings in folders of its own", "seq-01"}));
}

TEST(RecordingLayouts, ScanNetExportWithALostPose) {
  const TemporaryFolder folder;
  for (int i = 0; i < 12; ++i) {
    folder.write("depth/" + std::to_string(i) + ".png", depthPng(i));
    folder.write("color/" + std::to_string(i) + ".jpg", "not looked at");
    folder.write("pose/" + std::to_string(i) + ".txt", matrixAt(i));
  }
  folder.write("pose/5.txt",
               "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
               "-inf -inf -inf -inf\n");
  folder.write("intrinsic/intrinsic_depth.txt", "5 0 3.5 0\n0 5.5 2.5 0\n0 0 1 0\n0 0 0 1\n");
  const SequenceReader reader(folder.path());
  EXPECT_EQ(reader.layout(), "ScanNet export");
  ASSERT_EQ(reader.size(), 12U);
  EXPECT_EQ(reader.camera().width, 8);
  EXPECT_EQ(reader.camera().cy, 2.5);
  expectCameraAt(reader.read(10), 10);
  EXPECT_EQ(reader.read(10).depth.pixels.at<std::uint16_t>(1, 1), 1010) << "10 follows 9, not 1";
  EXPECT_TRUE(
      tells(sentenceOf([&] { (void)reader.read(5); }), {"pose/5.txt", "tracking was lost"}));
  ASSERT_EQ(reader.assumptions().size(), 1U);
  EXPECT_TRUE(tells(reader.assumptions().front(), {"no stamps", "30 a second"}));
}

TEST(RecordingLayouts, ReplicaOfNiceSlam) {
  const TemporaryFolder folder;
  std::string trajectory;
  for (int i = 0; i < 3; ++i) {
    folder.write("room0/results/depth00000" + std::to_string(i) + ".png", depthPng(i));
    folder.write("room0/results/frame00000" + std::to_string(i) + ".jpg", "not looked at");
    trajectory += matrixAt(i, " ") + "\n";
  }
  folder.write("room0/traj.txt", trajectory);
  folder.write("cam_params.json",
               R"({"camera": {"w": 8, "h": 6, "fx": 5, "fy": 5.5, "cx": 3.5, "cy": 2.5,
                   "scale": 6553.5}})");
  const SequenceReader reader(folder.at("room0"));
  ASSERT_EQ(reader.size(), 3U);
  expectCameraAt(reader.read(1), 1);
  EXPECT_EQ(reader.read(1).depth.units_per_m, 6553.5);
  EXPECT_EQ(reader.read(1).color_path, folder.at("room0/results/frame000001.jpg"));
  EXPECT_TRUE(tells(reader.assumptions().at(0), {"no stamps", "30 a second"}));
}

TEST(RecordingLayouts, IclNuimWhoseRowsGoUp) {
  const TemporaryFolder folder;
  std::string trajectory;
  for (int i = 0; i < 3; ++i) {
    folder.write("depth/" + std::to_string(i) + ".png", depthPng(i, 640, 480));
    trajectory += std::to_string(i) + " " + std::to_string(i) + " 2 3 0.5 -0.5 0.5 -0.5\n";
  }
  folder.write("livingRoom0.gt.freiburg", trajectory);
  const SequenceReader reader(folder.path());
  ASSERT_EQ(reader.size(), 3U);
  const Frame frame = reader.read(1);
  expectCameraAt(frame, 1);
  EXPECT_EQ(frame.depth.units_per_m, 5000.0);
  EXPECT_EQ(frame.depth.pixels.at<std::uint16_t>(479, 0), 65535) << "the first row is the lowest";
  EXPECT_EQ(frame.camera.fy, 480.0);
  EXPECT_TRUE(tells(reader.assumptions().at(1), {"no stamps", "30 a second"}));
}

TEST(RecordingLayouts, RtabmapExportNamedById) {
  const TemporaryFolder folder;
  folder.write("rtabmap_depth/7.png", depthPng(7));
  folder.write("rtabmap_depth/12.png", depthPng(12));
  folder.write("rtabmap_rgb/12.jpg", "not looked at");
  folder.write("rtabmap_calib/7.yaml",
               "%YAML:1.0\n---\ncamera_name: \"7\"\nimage_width: 8\nimage_height: 6\n"
               "camera_matrix:\n   rows: 3\n   cols: 3\n   data: [ 5., 0., 3.5, 0., 5.5, 2.5, 0., "
               "0., 1. ]\n");
  folder.write("rtabmap_camera_poses.txt",
               "#timestamp x y z qx qy qz qw id\n"
               "1700000000.5 7 2 3 0.5 -0.5 0.5 -0.5 7\n"
               "1700000003.5 12 2 3 0.5 -0.5 0.5 -0.5 12\n");
  const SequenceReader reader(folder.path());
  EXPECT_EQ(reader.layout(), "RTAB-Map export");
  ASSERT_EQ(reader.size(), 2U);
  expectCameraAt(reader.read(1), 12);
  EXPECT_EQ(reader.read(1).stamp_s, 1700000003.5);
  EXPECT_EQ(reader.read(1).color_path, folder.at("rtabmap_rgb/12.jpg"));
}

TEST(RecordingLayouts, TumAsDownloadedHasItsKnownCamera) {
  const TemporaryFolder folder;
  const std::string name = "rgbd_dataset_freiburg2_desk";
  folder.write(name + "/depth/a.png", depthPng(1, 640, 480));
  folder.write(name + "/depth.txt", "# depth maps\n1311868164.39 depth/a.png\n");
  folder.write(name + "/groundtruth.txt", "1311868164.38 1 2 3 0.5 -0.5 0.5 -0.5\n");
  const SequenceReader reader(folder.at(name));
  EXPECT_EQ(reader.camera().fx, 520.9);
  expectCameraAt(reader.read(0), 1);
  EXPECT_EQ(reader.read(0).depth.units_per_m, 5000.0);
  EXPECT_TRUE(tells(reader.assumptions().at(0), {"freiburg2", "5000"}));
}

TEST(RecordingLayouts, AssociationsStandForTheTwoLists) {
  const RecordedSequence sequence;
  std::filesystem::remove(sequence.folder.at("depth.txt"));
  sequence.folder.write("associations.txt",
                        "0.0 rgb/0.png 0.0 depth/0.png\n0.2 rgb/1.png 0.2 depth/1.png\n");
  const SequenceReader reader(sequence.path());
  ASSERT_EQ(reader.size(), 2U);
  EXPECT_EQ(reader.read(1).depth_path, sequence.folder.at("depth/1.png"));
  EXPECT_EQ(reader.read(1).color_path, sequence.folder.at("rgb/1.png"));
}

TEST(RecordingLayouts, UnknownFolderIsToldWhatItHoldsAndTheNearestLayout) {
  const TemporaryFolder folder;
  folder.write("depth/0.png", depthPng(0));
  folder.write("notes.txt", "");
  EXPECT_TRUE(tells(sentenceOf([&] { SequenceReader reader(folder.path()); }),
                    {"1 folder (depth), 1 .txt", "nearest is TUM RGB-D", "groundtruth.txt"}));
  const TemporaryFolder results;
  results.write("scene_graph.json", "{}");
  EXPECT_TRUE(tells(sentenceOf([&] { SequenceReader reader(results.path()); }),
                    {"holds results of 'occusg run'", "occusg show"}));
  const TemporaryFolder bag;
  bag.write("run.bag", "");
  EXPECT_TRUE(tells(sentenceOf([&] { SequenceReader reader(bag.at("run.bag")); }),
                    {"run.bag", "occusg_bag"}));
}

SequenceReaderConfig withPoses(const std::string& path) {
  SequenceReaderConfig config;
  config.poses_path = path;
  return config;
}

TEST(Trajectories, EurocHasCommasNanosecondsAndWFirst) {
  const RecordedSequence sequence(1);
  sequence.folder.write("depth.txt", "1403636579763555584 depth/0.png\n");
  sequence.folder.write(
      "data.csv",
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z "
      "[],v_RS_R_x [m s^-1],v_RS_R_y [m s^-1],v_RS_R_z [m s^-1]\n"
      "1403636579763555584,4,2,3,-0.5,0.5,-0.5,0.5,0,0,0\n");
  const SequenceReader reader(sequence.path(), withPoses(sequence.folder.at("data.csv")));
  expectCameraAt(reader.read(0), 4);
  EXPECT_NEAR(reader.read(0).stamp_s, 1403636579.763555584, 1e-6);
  for (const std::string& assumption : reader.assumptions())
    EXPECT_FALSE(tells(assumption, {"data.csv"})) << "the unit is stated";
}

TEST(Trajectories, UnitOfTheStampsIsThatOfTheHeaderHoweverSmallTheyAre) {
  const RecordedSequence sequence(2);  // images at 0 and 0.2 s
  sequence.folder.write("data.csv",
                        "#timestamp [ns],x [m],y [m],z [m],q_w [],q_x [],q_y [],q_z []\n"
                        "0,4,2,3,-0.5,0.5,-0.5,0.5\n200000000,5,2,3,-0.5,0.5,-0.5,0.5\n");
  const SequenceReader reader(sequence.path(), withPoses(sequence.folder.at("data.csv")));
  expectCameraAt(reader.read(1), 5);
}

TEST(Trajectories, UnitOfTheStampsIsGuessedFromTheirSizeWhereNoHeaderStatesIt) {
  const RecordedSequence sequence(1);
  sequence.folder.write("depth.txt", "1403636579763555584 depth/0.png\n");
  sequence.folder.write("poses.txt", "1403636579763555584 4 2 3 0.5 -0.5 0.5 -0.5\n");
  const SequenceReader reader(sequence.path(), withPoses(sequence.folder.at("poses.txt")));
  EXPECT_TRUE(tells(reader.assumptions().at(0), {"poses.txt", "because of their size"}));
}

TEST(SequenceReader, ByteOrderMarksBeforeTheListsAreNoPartOfThem) {
  const RecordedSequence sequence(1);
  sequence.folder.write("depth.txt", "\xEF\xBB\xBF# stamp file\n0.0 depth/0.png\n");
  sequence.folder.write("groundtruth.txt",
                        "\xEF\xBB\xBF"
                        "0.0 4 2 3 0.5 -0.5 0.5 -0.5\n");
  const SequenceReader reader(sequence.path());
  EXPECT_EQ(reader.size(), 1U);
  EXPECT_TRUE(reader.unusableLines().empty());
}

TEST(Trajectories, AColumnThatIsNoPartOfAPoseIsNamedWhenTheLinesCannotBeRead) {
  const RecordedSequence sequence(1);
  const auto sentence = [&](const std::string& header, const std::string& line) {
    sequence.folder.write("odd.txt", header + "\n" + line + "\n");
    return sentenceOf(
        [&] { SequenceReader(sequence.path(), withPoses(sequence.folder.at("odd.txt"))); });
  };
  EXPECT_TRUE(
      tells(sentence("#timestamp x y z qx qy qz qw confidence", "0 4 2 3 0.5 -0.5 0.5 -0.5 9"),
            {"odd.txt:2", "has 9 fields", "the header's column \"confidence\""}));
  EXPECT_TRUE(tells(sentence("time x y z roll pitch yaw quality", "0 4 2 3 0.5 0.1 0.2 9"),
                    {"odd.txt:2", "norm", "the header's column \"roll\""}));
}

TEST(Trajectories, WFirstWhenItIsSaid) {
  const RecordedSequence sequence(1);
  sequence.folder.write("w.txt", "0.0 4 2 3 -0.5 0.5 -0.5 0.5\n");
  SequenceReaderConfig config = withPoses(sequence.folder.at("w.txt"));
  config.w_first = true;
  expectCameraAt(SequenceReader(sequence.path(), config).read(0), 4);
}

TEST(Trajectories, BodyPosesBecomeTheCamera) {
  const RecordedSequence sequence(1);
  // A body that looks along x of the map, as the map's axes lie.
  sequence.folder.write("groundtruth.txt", "0.0 4 2 3 0 0 0 1\n");
  SequenceReaderConfig config;
  config.pose_frame = PoseFrame::kBody;
  expectCameraAt(SequenceReader(sequence.path(), config).read(0), 4);
}

TEST(Trajectories, FewerPosesThanImagesAreInterpolatedWithinLimits) {
  const RecordedSequence sequence(4);  // images at 0, 0.2, 0.4, 0.6 s
  const double half = std::sqrt(0.5);
  sequence.folder.write("groundtruth.txt",
                        "0.0 0 0 1 0 0 0 1\n0.4 0.4 0 1 0 0 0.1 0.995\n"
                        "0.8 0.4 0 1 0 0 " +
                            std::to_string(half) + " " + std::to_string(half) + "\n");
  const SequenceReader reader(sequence.path());
  const Pose between = reader.read(1).T_map_camera;
  EXPECT_TRUE(between.translation().isApprox(Eigen::Vector3d(0.2, 0, 1), 1e-6));
  EXPECT_NEAR(Eigen::AngleAxisd(between.linear()).angle(), std::atan2(0.1, 0.995), 1e-3);
  EXPECT_EQ(reader.interpolatedPoses(), 1U);
  EXPECT_TRUE(
      tells(sentenceOf([&] { (void)reader.read(3); }), {"nearest to 0.6 s", "apart, are needed"}))
      << "the poses around it turn by 79 degrees";
}

TEST(Trajectories, MatricesWithoutStampsBelongToTheImagesOneByOne) {
  const RecordedSequence sequence(2);
  sequence.folder.write("kitti.txt", "0 0 1 7 -1 0 0 2 0 -1 0 3\n0 0 1 8 -1 0 0 2 0 -1 0 3\n");
  expectCameraAt(
      SequenceReader(sequence.path(), withPoses(sequence.folder.at("kitti.txt"))).read(1), 8);
  sequence.folder.write("short.txt", "0 0 1 7 -1 0 0 2 0 -1 0 3\n");
  EXPECT_TRUE(tells(sentenceOf([&] {
                      SequenceReader reader(sequence.path(),
                                            withPoses(sequence.folder.at("short.txt")));
                    }),
                    {"short.txt", "1 matrices", "2 depth images"}));
}

TEST(CameraFiles, EveryKindGivesTheSameCamera) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"ours.json", kSmallCamera},
      {"open3d.json",
       R"({"width": 8, "height": 6, "intrinsic_matrix": [5, 0, 0, 0, 5.5, 0, 3.5, 2.5, 1]})"},
      {"ros.yaml",
       "image_width: 8\nimage_height: 6\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [5, 0, 3.5, "
       "0, 5.5, 2.5, 0, 0, 1]\ndistortion_coefficients:\n  data: [0, 0, 0, 0, 0]\n"},
      {"matrix.txt", "5 0 3.5\n0 5.5 2.5\n0 0 1\n"}};
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    const RecordedSequence sequence(1);
    sequence.folder.write(name, text);
    SequenceReaderConfig config;
    config.camera_path = sequence.folder.at(name);
    config.depth_units_per_m = 4000.0;
    const SequenceReader reader(sequence.path(), config);
    EXPECT_EQ(reader.camera().width, 8);
    EXPECT_EQ(reader.camera().height, 6);
    EXPECT_EQ(reader.camera().fx, 5.0);
    EXPECT_EQ(reader.camera().fy, 5.5);
    EXPECT_EQ(reader.camera().cx, 3.5);
    EXPECT_EQ(reader.camera().cy, 2.5);
    EXPECT_EQ(reader.read(0).depth.units_per_m, 4000.0);
    EXPECT_TRUE(reader.assumptions().empty());
  }
}

TEST(CameraFiles, DistortionIsSaid) {
  const RecordedSequence sequence(1);
  sequence.folder.write("camera.json",
                        R"({"width": 8, "height": 6, "fx": 5, "fy": 5.5, "cx": 3.5, "cy": 2.5,
                            "depth_scale": 1000, "D": [0.2, -0.1, 0, 0, 0]})");
  EXPECT_TRUE(tells(SequenceReader(sequence.path()).assumptions().at(0),
                    {"distortion", "taken as rectified"}));
}

}  // namespace
}  // namespace occusg
