// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "drawn_grid.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg::testing {

/// Two rooms of 4 m x 4 m side by side, the wall between them 0.2 m thick, a door of `door_m` in
/// its middle. The left room is [0.2, 4.2] x [0.2, 4.2], the right one [4.4, 8.4] x [0.2, 4.2].
inline FreeSpace twoRooms(double door_m, double resolution_m = 0.05) {
  FreeSpace layer = solid(8.6, 4.4, resolution_m);
  fill(layer, 0.2, 0.2, 4.2, 4.2);
  fill(layer, 4.4, 0.2, 8.4, 4.2);
  fill(layer, 4.2, 2.2 - door_m / 2, 4.4, 2.2 + door_m / 2);
  return layer;
}

/// Uniform in [low, high]; std::uniform_int_distribution differs between standard libraries.
inline int uniform(std::mt19937& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

/// Rooms in a raster with random walls, doors, furniture, unknown patches and noise. Any corner.
inline FreeSpace randomFloorPlan(std::uint32_t seed) {
  std::mt19937 random(seed);
  const int width = uniform(random, 1, 120);
  const int height = uniform(random, 1, 120);
  const Cell corner{uniform(random, -300, 300), uniform(random, -300, 300)};
  const CellBox box{corner, {corner.x + width, corner.y + height}};
  FreeSpace layer{GridFrame{0.05}, FreeSpaceCells(box, kFree), box};
  const int pitch = uniform(random, 8, 60);
  const auto paint = [&](int x0, int y0, int x1, int y1, std::int8_t value) {
    const CellBox painted =
        CellBox{{corner.x + x0, corner.y + y0}, {corner.x + x1, corner.y + y1}}.intersected(box);
    for (int y = painted.min.y; y < painted.max.y; ++y)
      for (int x = painted.min.x; x < painted.max.x; ++x) layer.cells.at({x, y}) = value;
  };
  const int thickness = uniform(random, 1, 4);
  for (int at = uniform(random, 0, pitch); at < 120; at += pitch) {
    paint(at, 0, at + thickness, 120, kFullObstacle);
    paint(0, at, 120, at + thickness, kFullObstacle);
  }
  for (int i = 0; i < 12; ++i) {  // Doors, wide and narrow; furniture; what nobody saw.
    const int x = uniform(random, 0, 119);
    const int y = uniform(random, 0, 119);
    const int size = uniform(random, 2, 24);
    paint(x, y, x + size, y + size, kFree);
    const std::int8_t clutter = i % 3 == 0 ? kUnknown : static_cast<std::int8_t>(5 * i + 1);
    paint(y, x, y + size / 2, x + size / 3, clutter);
  }
  for (int i = uniform(random, 0, 200); i > 0; --i) {
    const int x = uniform(random, 0, 119);
    const int y = uniform(random, 0, 119);
    paint(x, y, x + 1, y + 1, i % 2 == 0 ? kFree : kFullObstacle);
  }
  return layer;
}

/// Every cell free with a probability of `free_percent`.
inline FreeSpace randomNoise(std::uint32_t seed, int free_percent) {
  std::mt19937 random(seed);
  const CellBox box{{-20, 7}, {40, 57}};
  FreeSpace layer{GridFrame{0.05}, FreeSpaceCells(box, kUnknown), box};
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (uniform(random, 0, 99) < free_percent) layer.cells.at({x, y}) = kFree;
  return layer;
}

/// `layer` moved by whole cells.
inline FreeSpace moved(const FreeSpace& layer, const Cell& by) {
  const CellBox& box = layer.cells.box();
  const CellBox target{{box.min.x + by.x, box.min.y + by.y}, {box.max.x + by.x, box.max.y + by.y}};
  Grid<std::int8_t> cells(target, kUnknown);
  cells.values() = layer.cells.dense().values();
  return {layer.frame, FreeSpaceCells(cells), target};
}

}  // namespace occusg::testing
