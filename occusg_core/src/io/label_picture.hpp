// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "occusg/geometry/grid.hpp"
#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// Largest id a picture of labels can hold.
inline constexpr std::int32_t kMaxPictureLabel = 65'535;

/// The labels of the cells in `box` as a 16-bit grey PNG, a pixel a cell, the highest y on top;
/// 0 where `labels` does not reach.
/// @throws Error when a label is negative or above kMaxPictureLabel, or the box is empty.
[[nodiscard]] std::string labelPng(const Grid<std::int32_t>& labels, const CellBox& box);

/// A room as a picture of labels holds it.
struct LabelledRoom {
  int id = 0;
  std::vector<Polygon> parts;  ///< Simple and disjoint: outlines of its 4-connected pieces [m].
};

/// Reads a 16-bit grey PNG of room ids, 0 = none. The lower left corner of the picture is the
/// origin, x right, y up. Rooms are ordered by id.
/// @throws Error naming the file when it is no such picture, is larger than 16384 pixels a side or
/// holds more than `kMaxRooms` rooms, or when the resolution is not positive and finite.
[[nodiscard]] std::vector<LabelledRoom> readLabelledRooms(const std::string& path,
                                                          double resolution_m);

}  // namespace occusg
