// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/camera_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr CameraModel kCamera{320, 240, 168.6, 168.6, 159.5, 119.5};

std::string refusal(const CameraModel& camera) {
  try {
    check(camera, "camera.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(CameraModel, AcceptsAnOrdinaryCameraAndTheLimits) {
  EXPECT_EQ(refusal(kCamera), "");
  EXPECT_EQ(refusal({1, 1, kMinFocalShare, kMaxFocalShare, 0.0, 1.0}), "");
  EXPECT_EQ(refusal({kMaxImageSide, kMaxImageSide, 8000.0, 8000.0, 0.0, kMaxImageSide}), "");
}

TEST(CameraModel, RefusalNamesPlaceFieldValueAndRange) {
  CameraModel camera = kCamera;
  camera.width = -4;
  EXPECT_EQ(refusal(camera), "camera.json: width is -4 pixels; it must be in [1, 16384]");
}

TEST(CameraModel, RefusesEveryFieldOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  struct Case {
    CameraModel camera;
    std::string field;
  };
  const std::vector<Case> cases = {
      {{0, 240, 100, 100, 1, 1}, "width"},
      {{kMaxImageSide + 1, 240, 100, 100, 1, 1}, "width"},
      {{320, 0, 100, 100, 1, 1}, "height"},
      {{320, std::numeric_limits<int>::max(), 100, 100, 1, 1}, "height"},
      {{320, 240, 0.0, 100, 1, 1}, "fx"},
      {{320, 240, nan, 100, 1, 1}, "fx"},
      {{320, 240, 1e-9, 100, 1, 1}, "fx"},
      {{320, 240, 7.9, 100, 1, 1}, "fx"},
      {{320, 240, 32001.0, 100, 1, 1}, "fx"},
      {{320, 240, 100, 5.9, 1, 1}, "fy"},
      {{320, 240, 100, -100, 1, 1}, "fy"},
      {{320, 240, 100, inf, 1, 1}, "fy"},
      {{320, 240, 100, 100, nan, 1}, "cx"},
      {{320, 240, 100, 100, 320.5, 1}, "cx"},
      {{320, 240, 100, 100, 1, -0.5}, "cy"},
      {{320, 240, 100, 100, 1, 241.0}, "cy"},
  };
  for (const Case& c : cases)
    EXPECT_EQ(refusal(c.camera).rfind("camera.json: " + c.field + " is ", 0), 0U)
        << "'" << refusal(c.camera) << "' should refuse " << c.field;
}

}  // namespace
}  // namespace occusg
