// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/map_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "drawn_grid.hpp"
#include "error_sentence.hpp"

namespace occusg {
namespace {

using testing::drawn;
using testing::sentenceOf;
using testing::tells;

TEST(MapFiles, HighestRowComesFirstInTheTrinaryGreys) {
  const MapFiles files = toMapFiles(drawn({"..#", " 19"}), "m.pgm");
  EXPECT_EQ(files.pgm, "P5\n3 2\n255\n\xFE\xFE" + std::string("\0\xCD\0\0", 4));
}

TEST(MapFiles, EveryObstacleLevelIsOccupied) {
  for (int level = 1; level <= 100; ++level) {
    FreeSpace layer = drawn({"."});
    layer.cells.at({0, 0}) = static_cast<std::int8_t>(level);
    EXPECT_EQ(toMapFiles(layer, "m.pgm").pgm.back(), '\0') << level;
  }
}

TEST(MapFiles, PictureOpensInOpenCv) {
  const std::string pgm = toMapFiles(drawn({"...", "..#"}), "m.pgm").pgm;
  const cv::Mat picture =
      cv::imdecode(std::vector<unsigned char>(pgm.begin(), pgm.end()), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(picture.size(), cv::Size(3, 2));
  EXPECT_EQ(picture.at<unsigned char>(1, 2), 0);
  EXPECT_EQ(picture.at<unsigned char>(0, 2), 254);
}

TEST(MapFiles, YamlHoldsTheLowerLeftCornerWithoutRoundingDigits) {
  const MapFiles files = toMapFiles(drawn({"."}, 0.05, {3, -7}), "free_space.pgm");
  EXPECT_EQ(files.yaml,
            "image: free_space.pgm\nresolution: 0.05\norigin: [0.15, -0.35, 0.0]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\n");
}

TEST(MapFiles, EmptyLayerIsOneUnknownCell) {
  const MapFiles files = toMapFiles(FreeSpace{}, "m.pgm");
  EXPECT_EQ(files.pgm, "P5\n1 1\n255\n\xCD");
  EXPECT_TRUE(tells(files.yaml.substr(0, files.yaml.find('\n')), {"image: m.pgm"}));
}

TEST(MapFiles, ResolutionThatIsNoneIsRefused) {
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL, -HUGE_VAL})
    EXPECT_TRUE(tells(sentenceOf([&] { (void)toMapFiles(drawn({"."}, bad), "m.pgm"); }),
                      {"map: resolution is", "positive number"}));
}

TEST(MapFiles, PictureNameThatYamlWouldMisreadIsRefused) {
  for (const char* bad : {"", "a b.pgm", "a: b", "-x.pgm", "../m.pgm", "m\n.pgm"})
    EXPECT_TRUE(tells(sentenceOf([&] { (void)toMapFiles(drawn({"."}), bad); }),
                      {"map: picture name", "letters, digits"}));
}

}  // namespace
}  // namespace occusg
