// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/scene_result.hpp"

namespace occusg {

/// The part of a scene a drawing shows.
struct DrawnPart {
  Bounds2 bounds;     ///< Map frame [m].
  std::string label;  ///< What the picture is called for those who cannot see it.
};

/// All rooms of a scene with a margin.
[[nodiscard]] Bounds2 boundsOf(const SceneResult& result);

/// An SVG element: predicted rooms filled, those without a valid match hatched; annotated rooms
/// outlined, those found at no IoU of 0.5 in red. North up, whole centimetres.
[[nodiscard]] std::string roomDrawing(const SceneResult& result, const DrawnPart& part);

/// The hatching the drawings of a page refer to; goes into the page once.
[[nodiscard]] std::string drawingPatterns();

}  // namespace occusg
