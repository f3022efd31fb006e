// SPDX-License-Identifier: BSD-3-Clause
// A sensor of your own: whatever gives points becomes a `PointCloud` in the map frame. Here a
// spinning laser with 32 rings stands in a room of 4 m by 3 m, which it then finds.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "occusg/occusg.hpp"

namespace {

/// How far a ray goes from `from` until it leaves [0, size]: along one axis.
double reach(double from, double direction, double size) {
  if (direction > 0.0) return (size - from) / direction;
  return direction < 0.0 ? -from / direction : 1e9;
}

occusg::PointCloud scan(double x, double y, double z) {
  constexpr double kPi = 3.14159265358979323846;
  constexpr int kRings = 32;
  constexpr int kRays = 720;
  occusg::PointCloud cloud;
  cloud.origin = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  for (int ring = 0; ring < kRings; ++ring) {
    const double pitch = (ring - kRings / 2 + 0.5) * kPi / 40.0;
    for (int ray = 0; ray < kRays; ++ray) {
      const double yaw = 2.0 * kPi * ray / kRays;
      const double dx = std::cos(pitch) * std::cos(yaw);
      const double dy = std::cos(pitch) * std::sin(yaw);
      const double dz = std::sin(pitch);
      const double length = std::min({reach(x, dx, 4.0), reach(y, dy, 3.0), reach(z, dz, 2.5)});
      cloud.points.push_back({static_cast<float>(x + length * dx),
                              static_cast<float>(y + length * dy),
                              static_cast<float>(z + length * dz)});
    }
  }
  return cloud;
}

}  // namespace

int main() {
  try {
    const occusg::PipelineConfig config = occusg::loadConfig("default");
    occusg::OccupancyMap map(config.occupancy);
    occusg::FreeSpaceLayer layer(config.free_space,
                                 occusg::GridFrame{config.occupancy.resolution_m});
    occusg::RoomPipeline rooms(config);
    for (int i = 0; i < 20; ++i) {
      const double x = 1.0 + 0.1 * i;
      const occusg::MapChange change = map.insert(scan(x, 1.5, 1.0));
      const occusg::FreeSpace& free_space = layer.update(map, change);
      occusg::Pose robot = occusg::Pose::Identity();
      robot.translation() = Eigen::Vector3d(x, 1.5, 0.0);
      rooms.update(free_space, free_space.changed, robot, 0.5 * i);
    }
    rooms.finish(10.0);
    for (const auto& [id, node] : rooms.graph().nodes(occusg::NodeType::kRoom))
      std::cout << rooms.graph().room(id).name << ": "
                << occusg::area(rooms.graph().room(id).polygon) << " m2\n";
  } catch (const occusg::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
