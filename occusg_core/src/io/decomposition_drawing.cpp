// SPDX-License-Identifier: BSD-3-Clause
#include "io/decomposition_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "geometry/cell_outline.hpp"
#include "io/canvas.hpp"
#include "io/json_text.hpp"
#include "io/map_drawing.hpp"
#include "io/overview_view.hpp"
#include "io/text_lines.hpp"
#include "regions/dude_pockets.hpp"

namespace occusg {
namespace {

constexpr RgbColor kObstaclePocketColor{255, 196, 120};
constexpr RgbColor kFreePocketColor{150, 205, 245};
constexpr RgbColor kBridgeColor{205, 120, 20};
constexpr RgbColor kInnerBridgeColor{40, 120, 190};
constexpr RgbColor kMinimumColor{110, 40, 150};
constexpr RgbColor kFootColor{20, 130, 90};
constexpr RgbColor kIgnoredColor{160, 220, 170};
constexpr RgbColor kCandidateColor{120, 126, 134};
constexpr RgbColor kCutColor{214, 48, 49};

constexpr double kBridgeWidth_px = 1.4;
constexpr double kCandidateWidth_px = 1.2;
constexpr double kCutWidth_px = 5.0;
constexpr double kPocketOpacity = 0.55;
/// Pockets shallower than this are not worth a tint.
constexpr double kMinPocketDepth_m = 0.3;
constexpr int kMaxPocketLevels = 8;

using Path = std::vector<cv::Point2d>;

/// A pocket as an area, and how deep it is nested.
struct Pocket {
  Ring ring;
  int level = 0;
};

/// The outlines the decomposition divided: those of all regions together.
std::vector<CellOutline> componentsOf(const Grid<std::int32_t>& labels) {
  Grid<std::uint8_t> mask(labels.box(), 0);
  std::transform(labels.values().begin(), labels.values().end(), mask.values().begin(),
                 [](std::int32_t label) { return label == kNoRegion ? 0 : 1; });
  return outlinesOf(mask);
}

std::vector<Pocket> pocketsOf(const Decomposition& decomposition) {
  std::vector<Pocket> pockets;
  if (decomposition.labels.empty()) return pockets;
  const GridFrame& frame = decomposition.frame;
  for (const CellOutline& component : componentsOf(decomposition.labels)) {
    const CornerRing& ring = component.outer;
    for (const DudeBridge& bridge :
         pocketTree(ring, kMinPocketDepth_m / frame.resolution_m, kMaxPocketLevels)) {
      Pocket& pocket = pockets.emplace_back(Pocket{{}, bridge.level});
      for (std::size_t i = bridge.first; i <= bridge.last; ++i)
        pocket.ring.push_back(frame.corner(ring[i % ring.size()]));
    }
  }
  // Inner pockets lie on outer ones.
  std::stable_sort(pockets.begin(), pockets.end(),
                   [](const Pocket& a, const Pocket& b) { return a.level < b.level; });
  return pockets;
}

/// The picture under construction.
class Drawing {
 public:
  Drawing(const OverviewView& view, double depth_threshold_m)
      : view_(view), threshold_m_(depth_threshold_m), canvas_(view.size) {}

  Canvas& canvas() { return canvas_; }

  void tintPockets(const std::vector<Pocket>& pockets) {
    const cv::Mat plain = canvas_.pixels().clone();
    for (const Pocket& pocket : pockets) {
      canvas_.fillRings({pathOf(pocket.ring)},
                        pocket.level % 2 == 0 ? kObstaclePocketColor : kFreePocketColor);
    }
    cv::Mat& pixels = canvas_.pixels();
    cv::addWeighted(pixels, kPocketOpacity, plain, 1.0 - kPocketOpacity, 0.0, pixels);
  }

  void drawIgnoredHoles(const std::vector<Polygon>& holes) {
    for (const Polygon& hole : holes) {
      canvas_.fillRings({pathOf(hole.outer)}, kIgnoredColor);
      canvas_.drawRing(pathOf(hole.outer), kFootColor, 1.0);
    }
  }

  void drawBridges(const std::vector<DudeTrace::Bridge>& bridges) {
    for (const DudeTrace::Bridge& bridge : bridges) {
      drawSegment(bridge.segment, bridge.level % 2 == 0 ? kBridgeColor : kInnerBridgeColor,
                  kBridgeWidth_px);
    }
  }

  void drawCandidates(const std::vector<DudeTrace::Cut>& cuts) {
    for (const DudeTrace::Cut& cut : cuts)
      drawSegment(cut.segment, kCandidateColor, kCandidateWidth_px);
  }

  void drawCuts(const std::vector<DudeTrace::Cut>& cuts) {
    for (const DudeTrace::Cut& cut : cuts) {
      drawSegment(cut.segment, kWhite, kCutWidth_px + 3.0);
      drawSegment(cut.segment, kCutColor, kCutWidth_px);
    }
  }

  void writeDepths(const std::vector<DudeTrace::Cut>& cuts) {
    const TextStyle style{10.5, 0.12, kCutColor};
    for (const DudeTrace::Cut& cut : cuts) {
      const std::string text = toText(rounded(cut.depth_m, 1)) + " m";
      const cv::Point2d middle = view_.pixelAt(midpoint(cut.segment));
      const cv::Point2d at(middle.x + 8.0, middle.y - 8.0);
      canvas_.drawHalo(text, at, style, kWhite, 2.0);
      canvas_.drawText(text, at, style);
    }
  }

  void drawMinima(const std::vector<DudeTrace::Feature>& minima) {
    for (const DudeTrace::Feature& minimum : minima)
      drawMinimum(view_.pixelAt(minimum.at), minimum.depth_m);
  }

  void drawFeet(const std::vector<Point2>& feet) {
    for (const Point2& foot : feet) drawFoot(view_.pixelAt(foot));
  }

  void drawSigns() {
    Legend legend(canvas_);
    legend.swatch(kObstaclePocketColor, kBridgeColor, "pocket of obstacle");
    legend.swatch(kFreePocketColor, kInnerBridgeColor, "pocket of free space");
    legend.swatch(kIgnoredColor, kFootColor, "furniture");
    legend.sign(12.0, "corner", [&](const cv::Point2d& at) {
      drawMinimum({at.x + 6.0, at.y}, threshold_m_);
    });
    legend.sign(12.0, "too shallow", [&](const cv::Point2d& at) {
      drawMinimum({at.x + 6.0, at.y}, 0.99 * threshold_m_);
    });
    legend.sign(10.0, "foot", [&](const cv::Point2d& at) { drawFoot({at.x + 5.0, at.y}); });
    legend.sign(24.0, "candidate", [&](const cv::Point2d& at) {
      canvas_.drawLine(at, {at.x + 24.0, at.y}, kCandidateColor, kCandidateWidth_px);
    });
    legend.sign(24.0, "cut, depth", [&](const cv::Point2d& at) {
      canvas_.drawLine(at, {at.x + 24.0, at.y}, kCutColor, kCutWidth_px);
    });
  }

 private:
  [[nodiscard]] Path pathOf(const Ring& ring) const {
    Path path;
    path.reserve(ring.size());
    for (const Point2& point : ring) path.push_back(view_.pixelAt(point));
    return path;
  }

  void drawSegment(const Segment2& segment, const RgbColor& color, double width_px) {
    canvas_.drawLine(view_.pixelAt(segment.a), view_.pixelAt(segment.b), color, width_px);
  }

  void drawMinimum(const cv::Point2d& at, double depth_m) {
    constexpr double kSmallest_px = 2.2;
    constexpr double kLargest_px = 7.0;
    const double share = threshold_m_ > 0.0 ? depth_m / threshold_m_ : 1.0;
    const double radius =
        std::clamp(3.4 * std::sqrt(std::max(share, 0.0)), kSmallest_px, kLargest_px);
    canvas_.drawDisc(at, radius, kMinimumColor);
    if (share < 1.0) canvas_.drawDisc(at, radius - 1.2, kWhite);
  }

  void drawFoot(const cv::Point2d& at) {
    canvas_.fillRectangle({at.x - 3.0, at.y - 3.0, 6.0, 6.0}, kFootColor);
  }

  const OverviewView& view_;
  double threshold_m_;
  Canvas canvas_;
};

std::string factsOf(const Decomposition& decomposition, const DudeTrace& trace,
                    double depth_threshold_m) {
  return "d_thr " + toText(rounded(depth_threshold_m, 2)) + " m   |   " +
         counted(trace.candidates.size(), "candidate") + "   |   " +
         counted(trace.cuts.size(), "cut") + "   |   " +
         counted(decomposition.regions.size(), "region");
}

}  // namespace

cv::Mat drawDecomposition(const FreeSpace& given_layer, const Decomposition& decomposition,
                          const DudeTrace& trace, double depth_threshold_m,
                          const std::string& title) {
  const FreeSpace layer = hasUsableFrame(given_layer) ? given_layer : FreeSpace{};
  const auto bounds = shownBounds(layer, {});
  const OverviewView view = viewOf(bounds.value_or(Bounds2{{0.0, 0.0}, {8.0, 4.0}}));
  Drawing drawing(view, depth_threshold_m);
  paintCells(drawing.canvas(), view, layer, CellKind::kFreeSpace);
  paintCells(drawing.canvas(), view, layer, CellKind::kObstacles);
  if (bounds) {
    drawing.tintPockets(pocketsOf(decomposition));
    drawing.drawIgnoredHoles(trace.ignored_holes);
    drawing.drawBridges(trace.bridges);
    drawing.drawCandidates(trace.candidates);
    drawing.drawCuts(trace.cuts);
    drawing.drawFeet(trace.feet);
    drawing.drawMinima(trace.minima);
    drawing.writeDepths(trace.cuts);
  }
  drawTitle(drawing.canvas(), printable(title), factsOf(decomposition, trace, depth_threshold_m));
  drawing.drawSigns();
  drawScaleBar(drawing.canvas(), view);
  return drawing.canvas().picture();
}

}  // namespace occusg
