// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "io/canvas.hpp"
#include "io/overview_view.hpp"
#include "occusg/mapping/free_space.hpp"

namespace occusg {

/// What all pictures of a map share: its cells, a title above, a legend and a scale bar below.

inline constexpr RgbColor kFreeColor{233, 235, 238};
inline constexpr RgbColor kWallColor{58, 62, 70};
inline constexpr RgbColor kInkColor{33, 37, 41};
inline constexpr RgbColor kFaintInkColor{108, 117, 125};
inline constexpr RgbColor kWhite{255, 255, 255};
inline constexpr RgbColor kSwatchRimColor{190, 195, 200};

enum class CellKind { kFreeSpace, kObstacles };

/// Paints the cells of one kind; both together would hide what is drawn between them.
void paintCells(Canvas& canvas, const OverviewView& view, const FreeSpace& layer, CellKind kind);

/// The title, shortened to fit, and a line of facts below it.
void drawTitle(Canvas& canvas, const std::string& title, const std::string& facts);

/// A round length that fits, in the lower right corner.
void drawScaleBar(Canvas& canvas, const OverviewView& view);

/// A legend under construction: each entry is a sign and a word, from left to right.
class Legend {
 public:
  /// Draws the rule above the legend.
  explicit Legend(Canvas& canvas);

  void swatch(const RgbColor& fill, const RgbColor& rim, const std::string& word);
  /// @param draw draws a sign of `width_px` to the right of the point it is given.
  void sign(double width_px, const std::string& word,
            const std::function<void(const cv::Point2d&)>& draw);

 private:
  Canvas& canvas_;
  cv::Point2d at_;
};

/// Finer than any map, and coarse enough that cell indices fit an int.
[[nodiscard]] bool hasUsableFrame(const FreeSpace& layer);

}  // namespace occusg
