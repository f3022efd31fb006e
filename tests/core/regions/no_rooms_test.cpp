// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/no_rooms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "drawn_grid.hpp"

namespace occusg {
namespace {

using testing::fill;
using testing::solid;

TEST(WhyNoRooms, SaysHowMuchIsFreeAndInHowLargePieces) {
  FreeSpace layer = solid(4.0, 2.0);
  fill(layer, 0.5, 0.5, 1.0, 1.0);
  fill(layer, 2.0, 0.5, 3.0, 1.0);
  fill(layer, 3.5, 0.0, 4.0, 2.0, kUnknown);
  const std::string why = whyNoRooms(layer, 1.0);
  EXPECT_NE(why.find("0.75 m2 are free in 2 pieces, the largest of 0.50 m2"), std::string::npos)
      << why;
  EXPECT_NE(why.find("a region needs 1.00 m2"), std::string::npos) << why;
  EXPECT_NE(why.find("6.25 m2 are occupied and 1.00 m2 unknown"), std::string::npos) << why;
}

TEST(WhyNoRooms, SaysOnePieceInTheSingular) {
  FreeSpace layer = solid(2.0, 2.0);
  fill(layer, 0.5, 0.5, 1.0, 1.0);
  EXPECT_NE(whyNoRooms(layer, 1.0).find("0.25 m2 are free in 1 piece, the"), std::string::npos);
}

TEST(WhyNoRooms, SaysThatNothingIsFree) {
  EXPECT_NE(whyNoRooms(solid(1.0, 1.0), 1.0).find("no cell is free; 1.00 m2 are occupied"),
            std::string::npos);
  EXPECT_NE(whyNoRooms(FreeSpace{}, 1.0).find("no free-space layer"), std::string::npos);
}

}  // namespace
}  // namespace occusg
