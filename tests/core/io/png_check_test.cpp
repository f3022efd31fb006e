// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/png_check.hpp"

#include <gtest/gtest.h>

#include "error_sentence.hpp"
#include "recorded_sequence.hpp"

namespace occusg {
namespace {

using testing::pngOf;
using testing::sentenceOf;
using testing::tells;

std::string checkFails(const std::string& bytes) {
  return sentenceOf([&] { (void)checkPng(bytes, "a.png"); });
}

const std::string& samplePng() {
  static const std::string kPng = pngOf(cv::Mat(3, 5, CV_16UC1, cv::Scalar(77)));
  return kPng;
}

TEST(PngCheck, TellsSizeDepthAndChannels) {
  const PngHeader header = checkPng(samplePng(), "a.png");
  EXPECT_EQ(header.width, 5);
  EXPECT_EQ(header.height, 3);
  EXPECT_EQ(header.bit_depth, 16);
  EXPECT_EQ(header.channels, 1);
  EXPECT_EQ(checkPng(pngOf(cv::Mat(2, 2, CV_8UC3)), "a.png").channels, 3);
  EXPECT_EQ(checkPng(pngOf(cv::Mat(2, 2, CV_8UC4)), "a.png").channels, 4);
}

TEST(PngCheck, WhatIsNoPngIsRefused) {
  EXPECT_TRUE(tells(checkFails(""), {"a.png: is empty"}));
  EXPECT_TRUE(tells(checkFails("\xFF\xD8\xFF jpeg it is"), {"a.png: is not a PNG"}));
}

TEST(PngCheck, EveryFlippedBitIsFound) {
  for (std::size_t i = 8; i < samplePng().size(); ++i) {
    SCOPED_TRACE(i);
    std::string bytes = samplePng();
    bytes[i] = static_cast<char>(bytes[i] ^ 4);
    EXPECT_TRUE(tells(checkFails(bytes), {"a.png", "complete PNG"}));
  }
}

TEST(PngCheck, BytesAfterTheEndAreNoHarm) {
  EXPECT_EQ(checkPng(samplePng() + "trailer", "a.png").width, 5);
}

TEST(PngCheck, HugeSizeIsRefusedBeforeDecoding) {
  // 16385 x 1, with the CRC of such a header.
  const std::string head("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x40\x01\0\0\0\x01\x10\0\0\0\0", 29);
  const std::string sentence = checkFails(head + std::string("\xbc\xa6\x5e\xf9", 4));
  EXPECT_TRUE(tells(sentence, {"16385 x 1", "from 1 to 16384"}));
}

TEST(PngCheck, FirstChunkMustBeTheHeader) {
  const std::string end = samplePng().substr(samplePng().size() - 12);
  EXPECT_TRUE(tells(checkFails(samplePng().substr(0, 8) + end),
                    {"a.png: does not begin with an image header"}));
}

}  // namespace
}  // namespace occusg
