// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/range_image.hpp"

#include <cstddef>

namespace occusg {

PointCloud toPointCloud(const RangeImage& image) {
  PointCloud cloud;
  cloud.origin = image.origin;
  cloud.drops = image.drops;
  cloud.points.reserve(image.hits);
  for (std::size_t i = 0; i < image.ends.size(); ++i) {
    if (image.kinds[i] == RayEnd::kHit) cloud.points.push_back(image.ends[i]);
    if (image.kinds[i] == RayEnd::kMiss) cloud.misses.push_back(image.ends[i]);
  }
  return cloud;
}

}  // namespace occusg
