// SPDX-License-Identifier: BSD-3-Clause
// Finds the rooms of a finished 2D map, as map_server saves it.
// Usage: 02_segment_map MAP.yaml
#include <iostream>

#include "occusg/occusg.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 02_segment_map MAP.yaml\n";
    return 2;
  }
  try {
    const occusg::GridMap map = occusg::readMap(argv[1]);
    for (const std::string& assumption : map.assumptions) std::cerr << assumption << '\n';
    occusg::ConstrictionDecomposer decomposer{occusg::ConstrictionDecomposerConfig{}};
    const occusg::Decomposition& rooms = decomposer.update(map.free_space);
    for (const occusg::Region& room : rooms.regions) {
      const occusg::Point2 middle = map.in_map(room.centroid);
      std::cout << room.id << ": " << room.area_m2 << " m2 around (" << middle.x << ", " << middle.y
                << "), beside " << room.adjacent.size() << " others\n";
    }
  } catch (const occusg::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
