// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/map_reader.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "error_sentence.hpp"
#include "recorded_sequence.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::pngOf;
using testing::sentenceOf;
using testing::tells;
using testing::TemporaryFolder;

/// A 3 x 2 picture: free, unknown, occupied in the top row; all free below.
std::string smallPgm() {
  return std::string("P5\n# by hand\n3 2\n255\n") + "\xFE\xCD" + '\0' + "\xFE\xFE\xFE";
}

constexpr const char* kYaml =
    "image: map.pgm\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

MapReaderOptions atFiveCentimetres() {
  MapReaderOptions options;
  options.resolution_m = 0.05;
  return options;
}

class MapReader : public ::testing::Test {
 protected:
  MapReader() {
    folder_.write("map.pgm", smallPgm());
    folder_.write("map.yaml", kYaml);
  }

  std::string yamlFails(const std::string& from, const std::string& to) {
    std::string yaml = kYaml;
    yaml.replace(yaml.find(from), from.size(), to);
    folder_.write("map.yaml", yaml);
    return sentenceOf([&] { (void)readMap(folder_.at("map.yaml")); });
  }
  std::string pictureFails(const std::string& bytes,
                           const MapReaderOptions& options = atFiveCentimetres()) {
    folder_.write("map.pgm", bytes);
    return sentenceOf([&] { (void)readMap(folder_.at("map.pgm"), options); });
  }
  std::int8_t valueOf(int grey, const MapReaderOptions& options) {
    // The second pixel is free in every mode used here.
    const char free = options.mode == MapMode::kRaw                  ? '\0'
                      : options.polarity == MapPolarity::kDarkIsFree ? '\0'
                                                                     : '\xFF';
    folder_.write("one.pgm", std::string("P5 2 1 255\n") + static_cast<char>(grey) + free);
    return readMap(folder_.at("one.pgm"), options).free_space.cells.at({0, 0});
  }

  TemporaryFolder folder_;
};

TEST_F(MapReader, TakesAMapServerMapWithItsFirstRowOnTop) {
  const GridMap map = readMap(folder_.at("map.yaml"));
  EXPECT_EQ(map.name, "map");
  EXPECT_EQ(map.free_space.frame.resolution_m, 0.05);
  EXPECT_EQ(map.free_space.cells.box(), (CellBox{{-20, 40}, {-17, 42}}));
  EXPECT_EQ(map.free_space.cells.dense().values(),
            (std::vector<std::int8_t>{kFree, kFree, kFree, kFree, kUnknown, kFullObstacle}));
  EXPECT_EQ(map.in_map.offset, (Point2{0.0, 0.0}));
}

TEST_F(MapReader, OriginBetweenCellsLeavesAnOffsetOfAtMostHalfACell) {
  std::string yaml = kYaml;
  yaml.replace(yaml.find("-1.0, 2.0"), 9, "-1.02, 2.02");
  folder_.write("map.yaml", yaml);
  const GridMap map = readMap(folder_.at("map.yaml"));
  EXPECT_EQ(map.free_space.cells.box().min, (Cell{-20, 40}));
  EXPECT_NEAR(map.in_map.offset.x, -0.02, 1e-12);
  EXPECT_NEAR(map.in_map.offset.y, 0.02, 1e-12);
}

TEST_F(MapReader, BarePictureLiesInTheFirstQuadrant) {
  const GridMap map = readMap(folder_.at("map.pgm"), atFiveCentimetres());
  EXPECT_EQ(map.free_space.cells.box(), (CellBox{{0, 0}, {3, 2}}));
  EXPECT_EQ(map.free_space.cells.at({1, 1}), kUnknown);
}

TEST_F(MapReader, PlainPgmAndPngHoldTheSameMap) {
  folder_.write("plain.pgm", "P2 3 2 255 254 205 # row\n 0 254 254 254\n");
  cv::Mat pixels = (cv::Mat_<std::uint8_t>(2, 3) << 254, 205, 0, 254, 254, 254);
  folder_.write("map.png", pngOf(pixels));
  const auto cells = readMap(folder_.at("map.pgm"), atFiveCentimetres()).free_space.cells;
  EXPECT_EQ(readMap(folder_.at("plain.pgm"), atFiveCentimetres()).free_space.cells, cells);
  EXPECT_EQ(readMap(folder_.at("map.png"), atFiveCentimetres()).free_space.cells, cells);
}

TEST_F(MapReader, ModesAndThresholdsMeanWhatMapServerSays) {
  MapReaderOptions options = atFiveCentimetres();
  EXPECT_EQ(valueOf(206, options), kFree);     // 0.192 < 0.196
  EXPECT_EQ(valueOf(205, options), kUnknown);  // 0.19608
  EXPECT_EQ(valueOf(90, options), kUnknown);   // 0.647
  EXPECT_EQ(valueOf(89, options), kFullObstacle);
  options.free_threshold = 0.0197;
  EXPECT_EQ(valueOf(250, options), kFree);  // 0.0196
  EXPECT_EQ(valueOf(249, options), kUnknown);
  options.mode = MapMode::kScale;
  options.free_threshold = 0.2;
  options.occupied_threshold = 0.6;
  EXPECT_EQ(valueOf(153, options), 50);  // 1 + 98 / 2
  options.mode = MapMode::kRaw;
  EXPECT_EQ(valueOf(100, options), 100);
  EXPECT_EQ(valueOf(101, options), kUnknown);
  options.mode = MapMode::kTrinary;
  options.polarity = MapPolarity::kDarkIsFree;
  EXPECT_EQ(valueOf(10, options), kFree);
  EXPECT_EQ(valueOf(240, options), kFullObstacle);
}

TEST_F(MapReader, OptionsGoBeforeTheYaml) {
  MapReaderOptions options;
  options.resolution_m = 0.1;
  options.origin = Point2{3.0, 0.0};
  const GridMap map = readMap(folder_.at("map.yaml"), options);
  EXPECT_EQ(map.free_space.frame.resolution_m, 0.1);
  EXPECT_EQ(map.free_space.cells.box().min, (Cell{30, 0}));
}

TEST_F(MapReader, BrokenYamlIsNamedWithItsLine) {
  EXPECT_TRUE(tells(yamlFails("image: map.pgm", "image: gone.pgm"),
                    {"map.yaml:", "image is 'gone.pgm', which does not exist"}));
  EXPECT_TRUE(tells(yamlFails("image: map.pgm\n", ""), {"map.yaml: names no image"}));
  EXPECT_TRUE(tells(yamlFails("0.05", "0"), {"map.yaml: has a resolution of 0"}));
  EXPECT_TRUE(tells(yamlFails("0.05", "-0.05"), {"has a resolution of -0.05 m"}));
  EXPECT_TRUE(tells(yamlFails("0.05", ".nan"), {"map.yaml:2: resolution is '.nan'"}));
  EXPECT_TRUE(tells(yamlFails("0.0]", "90.0]"), {"turned by 90.0 rad", "within a full turn"}));
  EXPECT_TRUE(tells(yamlFails(", 0.0]", "]"), {"map.yaml:3: origin is not a list of three"}));
  EXPECT_TRUE(tells(yamlFails("2.0,", "up,"), {"map.yaml:3: origin is 'up' in part"}));
  EXPECT_TRUE(tells(yamlFails("origin: [-1.0, 2.0, 0.0]\n", ""), {"map.yaml: has no origin"}));
  EXPECT_TRUE(tells(yamlFails("free_thresh: 0.196\n", ""), {"map.yaml: has no free_thresh"}));
  EXPECT_TRUE(tells(yamlFails("0.196", "0.7"), {"free 0.7 and occupied 0.65"}));
  EXPECT_TRUE(tells(yamlFails("negate: 0", "negate: 2"), {"map.yaml:4: negate is '2'"}));
  EXPECT_TRUE(tells(yamlFails("negate: 0", "mode: grey"), {"map.yaml:4: mode is 'grey'"}));
  EXPECT_TRUE(tells(yamlFails("negate: 0", "negate: [0]"), {"map.yaml:4: negate is not a single"}));
  EXPECT_TRUE(tells(yamlFails("image: map.pgm", "image: \"map\\n\""), {"image is 'map?'"}));
  EXPECT_TRUE(tells(yamlFails("image: map.pgm", "image: [map"), {"is not YAML"}));
  EXPECT_TRUE(tells(yamlFails(kYaml, "- 1\n"), {"map.yaml: holds no keys"}));
  EXPECT_TRUE(tells(yamlFails("-1.0", "-1e9"), {"coordinates up to"}));
}

TEST_F(MapReader, KeysThatHaveNoEffectAreTold) {
  folder_.write("map.yaml", std::string(kYaml) + "resolution: 0.1\nmodes: scale\n");
  const GridMap map = readMap(folder_.at("map.yaml"));
  EXPECT_EQ(map.free_space.frame.resolution_m, 0.05);
  ASSERT_EQ(map.assumptions.size(), 2U);
  EXPECT_EQ(map.assumptions[0], "resolution is written twice; the first value counts");
  EXPECT_EQ(map.assumptions[1],
            "the key 'modes' is none of map_server's and was ignored; did you mean 'mode'?");
}

TEST_F(MapReader, ValuesAboveTheLargestOfTheHeaderAreTold) {
  folder_.write("bright.pgm", "P5 2 1 100\n\x64\xFF");
  const GridMap map = readMap(folder_.at("bright.pgm"), atFiveCentimetres());
  ASSERT_FALSE(map.assumptions.empty());
  EXPECT_EQ(map.assumptions[0],
            "1 of the picture's values is above 100, the largest by its header; it was read as "
            "that");
}

TEST_F(MapReader, DeepNestingNeverReachesTheParser) {
  EXPECT_TRUE(tells(yamlFails("0.05", std::string(30000, '[')), {"is nested deeply"}));
  EXPECT_TRUE(tells(yamlFails("image", "- - - - image"), {"is nested deeply"}));
  EXPECT_TRUE(tells(yamlFails("image", std::string(100, ' ') + "image"), {"is nested deeply"}));
  EXPECT_TRUE(
      tells(yamlFails("image", "#" + std::string(70000, 'x') + "\nimage"), {"at most 65536"}));
}

TEST_F(MapReader, PicturesOfAnotherKindAreNamed) {
  EXPECT_TRUE(tells(pictureFails("GIF89a"), {"is no picture that is read", "a PNG, PGM"}));
  EXPECT_TRUE(tells(pictureFails(""), {"map.pgm: is empty"}));
}

TEST_F(MapReader, IncompletePicturesAreNamed) {
  EXPECT_TRUE(tells(pictureFails("P5 3 2 255\n12345"), {"ends before its last pixel", "3 x 2"}));
  EXPECT_TRUE(tells(pictureFails("P2 3 2 255\n1 2 3 4 5"), {"ends before its last pixel"}));
  EXPECT_TRUE(tells(pictureFails("P2 3 2 255\n1 2 x 4 5 6"), {"no number", "pixel 3"}));
  EXPECT_TRUE(tells(pictureFails("P2 1 1 255\n256"), {"has a pixel of value 256"}));
  EXPECT_TRUE(tells(pictureFails("P5 3"), {"has no readable header of a portable map"}));
  EXPECT_TRUE(
      tells(pictureFails("P5 12345678901 2 255\n"), {"has no readable header of a portable map"}));
  const std::string png = pngOf(cv::Mat(20, 20, CV_8UC1, cv::Scalar(255)));
  EXPECT_TRUE(tells(pictureFails(png.substr(0, png.size() - 20)), {"truncated"}));
}

TEST_F(MapReader, HugePicturesAreRefusedByTheirHeader) {
  EXPECT_TRUE(tells(pictureFails("P5 65000 65000 255\n"),
                    {"65000 x 65000 = 4225000000 cells", "at most 100000000", "--max-cells"}));
  EXPECT_TRUE(tells(pictureFails("P5 2000000 1 255\n"), {"2000000 x 1", "sides"}));
  EXPECT_TRUE(tells(pictureFails("P5 0 1 255\n"), {"0 x 1", "sides"}));
  const std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xfd\xe8\0\0\xfd\xe8\x08\0\0\0\0", 29);
  EXPECT_TRUE(tells(pictureFails(head), {"65000 x 65000", "--max-cells"}));
  MapReaderOptions options = atFiveCentimetres();
  options.max_cells = 5;
  EXPECT_TRUE(tells(pictureFails(smallPgm(), options), {"3 x 2 = 6 cells", "at most 5"}));
  options.max_cells = kMaxMapCells + 1;
  EXPECT_TRUE(tells(pictureFails(smallPgm(), options), {"max_cells"}));
}

TEST_F(MapReader, MapWithoutAFreeCellIsRefused) {
  EXPECT_TRUE(
      tells(pictureFails(std::string("P5 2 1 255\n") + "\x01\xCD"), {"has no free cell", "0.196"}));
  MapReaderOptions options = atFiveCentimetres();
  options.mode = MapMode::kRaw;
  EXPECT_TRUE(tells(pictureFails("P5 2 1 255\n12", options), {"has no free cell", "raw"}));
}

TEST_F(MapReader, BarePictureNeedsAResolution) {
  EXPECT_TRUE(
      tells(pictureFails(smallPgm(), {}), {"map.pgm: says nothing of its scale", "--resolution"}));
  for (const double resolution : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::infinity()}) {
    MapReaderOptions options;
    options.resolution_m = resolution;
    EXPECT_TRUE(tells(pictureFails(smallPgm(), options), {"has a resolution of"}));
  }
}

}  // namespace
}  // namespace occusg
