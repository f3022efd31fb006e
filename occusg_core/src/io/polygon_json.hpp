// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "occusg/geometry/polygon.hpp"
#include "occusg/io/rooms_file.hpp"

namespace occusg {

/// Reading of points and polygons, strict, with sentences that `where` opens.

/// A coordinate within 1e6 m of the origin.
[[nodiscard]] double coordinateOf(const nlohmann::json& value, const std::string& where);
/// [x, y].
[[nodiscard]] Point2 pointOf(const nlohmann::json& value, const std::string& where);
/// [[x, y], [x, y]].
[[nodiscard]] Segment2 segmentOf(const nlohmann::json& value, const std::string& where);

/// Reads rings until the file's share of vertices is used up.
class RingReader {
 public:
  explicit RingReader(std::string file, RingOrder order = RingOrder::kOriented,
                      std::size_t max_vertices = kMaxRoomVertices)
      : file_(std::move(file)), order_(order), max_vertices_(max_vertices) {}

  /// A ring of at least three vertices, without a repeated last one.
  [[nodiscard]] Ring read(const nlohmann::json& value, const std::string& where);
  /// The members "polygon" and, if there, "holes"; outer ring counter-clockwise, holes clockwise,
  /// unless the order is that of the file.
  [[nodiscard]] Polygon polygonOf(const nlohmann::json& value, const std::string& where);

 private:
  /// Sign of the area of a ring as `Polygon` asks for.
  enum class Winding { kOuter = 1, kHole = -1 };

  [[nodiscard]] Ring wound(Ring ring, Winding winding) const;

  std::string file_;
  RingOrder order_;
  std::size_t max_vertices_;
  std::size_t vertices_ = 0;
};

}  // namespace occusg
