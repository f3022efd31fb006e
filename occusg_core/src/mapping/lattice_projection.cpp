// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/lattice_projection.hpp"

namespace occusg {

LatticeProjection::LatticeProjection(const RangeImage& image, float slack_pixels)
    : width_(image.camera.width),
      height_(image.camera.height),
      last_column_(static_cast<float>(image.camera.width - 1)),
      last_row_(static_cast<float>(image.camera.height - 1)),
      cx_(static_cast<float>(image.camera.cx)),
      cy_(static_cast<float>(image.camera.cy)),
      pitch_x_(static_cast<float>(1.0 / image.camera.fx)),
      pitch_y_(static_cast<float>(1.0 / image.camera.fy)),
      slack_pixels_(slack_pixels) {
  dense_depth_ = 2.0F * kSurelyCrossed / std::hypot(pitch_x_, pitch_y_);
  for (int axis = 0; axis < 3; ++axis) {
    const auto row = image.T_map_camera.linear().row(axis);
    steps_[static_cast<std::size_t>(axis)] = {static_cast<float>(row[0] * image.camera.fx),
                                              static_cast<float>(row[1] * image.camera.fy),
                                              static_cast<float>(row[2])};
  }
  for (std::size_t size = 0; size < kSizes; ++size) {
    CubeCorners& cube = corners_[size];
    const float half = 4.0F / static_cast<float>(1U << size);
    for (unsigned corner = 0; corner < 8; ++corner) {
      ViewPoint at;
      for (unsigned axis = 0; axis < 3; ++axis)
        at = at + ((corner >> axis & 1U) != 0 ? half : -half) * steps_[axis];
      cube.x[corner] = at.x;
      cube.y[corner] = at.y;
      cube.z[corner] = at.z;
    }
    cube.width = cube.x.maxCoeff();
    cube.height = cube.y.maxCoeff();
    cube.depth = cube.z.maxCoeff();
  }
}

}  // namespace occusg
