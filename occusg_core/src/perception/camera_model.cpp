// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/camera_model.hpp"

#include <cmath>
#include <string>

#include "occusg/error.hpp"

namespace occusg {
namespace {

void checkSide(const std::string& where, const char* field, int side) {
  if (side >= 1 && side <= kMaxImageSide) return;
  throw refuse(where, std::string(field) + " is " + std::to_string(side) + " pixels",
               "it must be in [1, " + std::to_string(kMaxImageSide) + "]");
}

void checkFocalLength(const std::string& where, const char* field, double focal_length, int side) {
  const double least = kMinFocalShare * side;
  const double most = kMaxFocalShare * side;
  if (focal_length >= least && focal_length <= most) return;
  throw refuse(where, std::string(field) + " is " + std::to_string(focal_length) + " pixels",
               "a focal length must be finite and positive, for an image of " +
                   std::to_string(side) + " pixels in [" + std::to_string(least) + ", " +
                   std::to_string(most) + "]");
}

void checkPrincipalPoint(const std::string& where, const char* field, double center, int side) {
  if (center >= 0.0 && center <= side) return;
  throw refuse(where, std::string(field) + " is " + std::to_string(center) + " pixels",
               "the principal point must lie in the image, in [0, " + std::to_string(side) + "]");
}

}  // namespace

void check(const CameraModel& camera, const std::string& where) {
  checkSide(where, "width", camera.width);
  checkSide(where, "height", camera.height);
  checkFocalLength(where, "fx", camera.fx, camera.width);
  checkFocalLength(where, "fy", camera.fy, camera.height);
  checkPrincipalPoint(where, "cx", camera.cx, camera.width);
  checkPrincipalPoint(where, "cy", camera.cy, camera.height);
}

}  // namespace occusg
