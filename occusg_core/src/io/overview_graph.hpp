// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/canvas.hpp"
#include "io/overview_view.hpp"

namespace occusg {

inline constexpr RgbColor kObjectColor{176, 92, 10};
inline constexpr RgbColor kLinkColor{120, 60, 160};

/// Draws which rooms are adjacent: from room to door to room.
void drawLinks(Canvas& canvas, const OverviewView& view, const OverviewContent& content);

/// Draws the objects' boxes from above, and their classes where there is room.
void drawObjects(Canvas& canvas, const OverviewView& view, const OverviewContent& content);

}  // namespace occusg
