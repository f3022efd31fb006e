// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "occusg/geometry/polygon.hpp"

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
  explicit RingReader(std::string file) : file_(std::move(file)) {}

  /// A ring of at least three vertices, without a repeated last one.
  [[nodiscard]] Ring read(const nlohmann::json& value, const std::string& where);
  /// The members "polygon" and, if there, "holes"; outer ring counter-clockwise, holes clockwise.
  [[nodiscard]] Polygon polygonOf(const nlohmann::json& value, const std::string& where);

 private:
  std::string file_;
  std::size_t vertices_ = 0;
};

}  // namespace occusg
