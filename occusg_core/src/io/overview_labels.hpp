// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/canvas.hpp"
#include "io/overview_view.hpp"

namespace occusg {

/// Writes id, label and area of each room where they cover no obstacle and, if possible, not the
/// trajectory; as many of the three as fit in a readable size, at least the id.
void drawRoomLabels(Canvas& canvas, const OverviewView& view, const FreeSpace& layer,
                    const OverviewContent& content);

/// "12.3 m^2" for `Canvas::drawText`.
[[nodiscard]] std::string areaText(double area_m2);

}  // namespace occusg
