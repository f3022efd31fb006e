// SPDX-License-Identifier: BSD-3-Clause
// The maps that ROS 1 map_server loads, in every form they come in.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "error_sentence.hpp"
#include "occusg/io/map_reader.hpp"
#include "recorded_sequence.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::pngOf;
using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

constexpr int kSide = 8;
constexpr int kUnknownGrey = 205;

/// The left half free, then two columns unknown, then two occupied.
cv::Mat threeGreys(int unknown = kUnknownGrey) {
  cv::Mat picture(kSide, kSide, CV_8UC1, cv::Scalar(254));
  picture(cv::Rect(4, 0, 2, kSide)).setTo(unknown);
  picture(cv::Rect(6, 0, 2, kSide)).setTo(0);
  return picture;
}

std::vector<std::int8_t> expectedRow() {
  return {kFree, kFree, kFree, kFree, kUnknown, kUnknown, kFullObstacle, kFullObstacle};
}

std::string encoded(const std::string& ending, const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(ending, picture, bytes);
  return {bytes.begin(), bytes.end()};
}

std::string yamlFor(const std::string& image,
                    const std::string& more = "origin: [0, 0, 0]\nfree_thresh: 0.196\n") {
  return "image: " + image + "\nresolution: 0.05\nnegate: 0\noccupied_thresh: 0.65\n" + more;
}

class MapServerMap : public ::testing::Test {
 protected:
  GridMap read(const std::string& name, const std::string& bytes) {
    folder_.write(name, bytes);
    folder_.write("map.yaml", yamlFor(name));
    return readMap(folder_.at("map.yaml"));
  }
  static std::vector<std::int8_t> firstRow(const GridMap& map) {
    const auto values = map.free_space.cells.dense().values();
    return {values.begin(), values.begin() + kSide};
  }

  TemporaryFolder folder_;
};

TEST_F(MapServerMap, GreyInColourWithAlphaOrInSixteenBitsIsTheSameMap) {
  const cv::Mat grey = threeGreys();
  cv::Mat colour;
  cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
  cv::Mat opaque;
  cv::cvtColor(grey, opaque, cv::COLOR_GRAY2BGRA);
  cv::Mat deep;
  grey.convertTo(deep, CV_16U, 257.0);
  EXPECT_EQ(firstRow(read("grey.png", pngOf(grey))), expectedRow());
  EXPECT_EQ(firstRow(read("rgb.png", pngOf(colour))), expectedRow());
  EXPECT_EQ(firstRow(read("rgba.png", pngOf(opaque))), expectedRow());
  EXPECT_EQ(firstRow(read("deep.png", pngOf(deep))), expectedRow());
  EXPECT_EQ(firstRow(read("grey.bmp", encoded(".bmp", grey))), expectedRow());
  EXPECT_EQ(firstRow(read("rgb.bmp", encoded(".bmp", colour))), expectedRow());
  EXPECT_EQ(firstRow(read("rgb.ppm", encoded(".ppm", colour))), expectedRow());
  EXPECT_EQ(firstRow(read("white.jpg",
                          encoded(".jpg", cv::Mat(kSide, kSide, CV_8UC3, cv::Scalar::all(255))))),
            (std::vector<std::int8_t>(kSide, kFree)));
}

TEST_F(MapServerMap, MeanOfTheColoursCounts) {
  cv::Mat colour(kSide, kSide, CV_8UC3, cv::Scalar::all(255));
  colour(cv::Rect(0, 0, 4, kSide))
      .setTo(cv::Scalar(0, 0, 255));  // the mean is 85: occupied by 0.667
  const std::vector<std::int8_t> row = firstRow(read("red.png", pngOf(colour)));
  EXPECT_EQ(row.front(), kFullObstacle);
  EXPECT_EQ(row.back(), kFree);
}

TEST_F(MapServerMap, TransparentPixelsAreUnknown) {
  cv::Mat picture(kSide, kSide, CV_8UC4, cv::Scalar(254, 254, 254, 255));
  picture(cv::Rect(0, 0, 2, kSide)).setTo(cv::Scalar(254, 254, 254, 0));
  const std::vector<std::int8_t> row = firstRow(read("holes.png", pngOf(picture)));
  EXPECT_EQ(row.front(), kUnknown);
  EXPECT_EQ(row.back(), kFree);
}

TEST_F(MapServerMap, PortableMapsOfAnyDepthAreRead) {
  EXPECT_EQ(read("bits.pbm", "P1\n2 1\n10\n").free_space.cells.dense().values(),
            (std::vector<std::int8_t>{kFullObstacle, kFree}));
  EXPECT_EQ(read("bits.pbm", std::string("P4 2 1\n") + '\x80').free_space.cells.dense().values(),
            (std::vector<std::int8_t>{kFullObstacle, kFree}));
  EXPECT_EQ(read("deep.pgm", std::string("P5 2 1 65535\n\0\0\xFF\xFF", 17))
                .free_space.cells.dense()
                .values(),
            (std::vector<std::int8_t>{kFullObstacle, kFree}));
  EXPECT_EQ(read("hundred.pgm", "P2 2 1 100\n0 100\n").free_space.cells.dense().values(),
            (std::vector<std::int8_t>{kFullObstacle, kFree}));
  EXPECT_EQ(read("colour.ppm", "P3 2 1 255\n0 0 0 255 255 255\n").free_space.cells.dense().values(),
            (std::vector<std::int8_t>{kFullObstacle, kFree}));
}

TEST_F(MapServerMap, TurnedOriginTurnsRoomsIntoTheMapFrame) {
  folder_.write("map.png", pngOf(threeGreys()));
  folder_.write("map.yaml", yamlFor("map.png", "origin: [1.0, 2.0, 0.5]\nfree_thresh: 0.196\n"));
  const GridMap map = readMap(folder_.at("map.yaml"));
  EXPECT_EQ(map.free_space.cells.box(), (CellBox{{0, 0}, {kSide, kSide}}));
  const Point2 corner = map.in_map(Point2{0.0, 0.0});
  const Point2 place = map.in_map(Point2{3.5, 3.25});
  EXPECT_EQ(corner, (Point2{1.0, 2.0}));
  EXPECT_NEAR(place.x, 1.0 + 3.5 * std::cos(0.5) - 3.25 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(place.y, 2.0 + 3.5 * std::sin(0.5) + 3.25 * std::cos(0.5), 1e-12);
}

TEST_F(MapServerMap, EverySpellingOfYamlIsTheSameMap) {
  folder_.write("map.png", pngOf(threeGreys()));
  for (const std::string& yaml :
       {std::string(
            "image: map.png\nresolution: 5.0e-2\norigin:\n- -3.2\n- -1.4\n- 0.0\nnegate: False\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n"),
        std::string("---\nimage: 'map.png' # comment\nresolution: 0.05\norigin: [ -3.2,\n  -1.4, 0 "
                    "]\nnegate: 0.0\n"
                    "occupied_thresh: .65\nfree_thresh: 0.196\nmode: Trinary\n"),
        std::string("{image: map.png, resolution: 0.05, origin: [-3.2, -1.4, 0], negate: no, "
                    "occupied_thresh: 0.65, "
                    "free_thresh: 0.196}\r\n")}) {
    folder_.write("map.yaml", yaml);
    const GridMap map = readMap(folder_.at("map.yaml"));
    EXPECT_EQ(map.free_space.cells.box().min, (Cell{-64, -28})) << yaml;
    EXPECT_EQ(firstRow(map), expectedRow()) << yaml;
  }
}

TEST_F(MapServerMap, PictureBesideAMovedYamlIsReadAndSaid) {
  folder_.write("map.png", pngOf(threeGreys()));
  folder_.write("map.yaml", yamlFor("/home/somebody/maps/map.png"));
  const GridMap map = readMap(folder_.at("map.yaml"));
  ASSERT_EQ(map.assumptions.size(), 1U);
  EXPECT_TRUE(
      tells(map.assumptions.front(), {"/home/somebody/maps/map.png is not there", "beside"}));
}

TEST_F(MapServerMap, MiddleOfThreeGreysIsUnknownWhateverTheThresholdsOfTheFileSay) {
  folder_.write("map.png", pngOf(threeGreys()));
  folder_.write("map.yaml", yamlFor("map.png", "origin: [0, 0, 0]\nfree_thresh: 0.25\n"));
  const GridMap map = readMap(folder_.at("map.yaml"));
  EXPECT_EQ(firstRow(map), expectedRow());
  ASSERT_EQ(map.assumptions.size(), 1U);
  EXPECT_TRUE(tells(map.assumptions.front(),
                    {"grey 205 (25 % of the pixels) counts as unknown", "free_thresh is 0.25"}));

  MapReaderOptions options;
  options.free_threshold = 0.25;
  const GridMap as_told = readMap(folder_.at("map.yaml"), options);
  EXPECT_EQ(firstRow(as_told)[4], kFree);
  EXPECT_TRUE(as_told.assumptions.empty());
}

TEST_F(MapServerMap, UsualThresholdsNeedNoAssumption) {
  EXPECT_TRUE(read("map.png", pngOf(threeGreys())).assumptions.empty());
  EXPECT_TRUE(read("map.png", pngOf(threeGreys(127))).assumptions.empty());
}

TEST_F(MapServerMap, ProbabilitiesAreFreeBelowOneHalf) {
  cv::Mat picture(64, 64, CV_8UC1);
  for (int row = 0; row < picture.rows; ++row)
    for (int x = 0; x < picture.cols; ++x)
      picture.at<std::uint8_t>(row, x) =
          static_cast<std::uint8_t>(x < 60 ? 150 + (x + row) % 80 : 20 + row % 60);
  picture(cv::Rect(0, 0, 64, 8)).setTo(128);
  folder_.write("map.png", pngOf(picture));
  folder_.write("map.yaml", yamlFor("map.png"));
  const GridMap map = readMap(folder_.at("map.yaml"));
  ASSERT_EQ(map.assumptions.size(), 1U);
  EXPECT_TRUE(tells(map.assumptions.front(), {"probabilities", "--free-thresh"}));
  const Grid<std::int8_t> cells = map.free_space.cells.dense();
  EXPECT_EQ(cells.at({10, 10}), kFree);
  EXPECT_EQ(cells.at({62, 10}), kFullObstacle);
  EXPECT_EQ(cells.at({10, 63}), kUnknown);
}

}  // namespace
}  // namespace occusg
