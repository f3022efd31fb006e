// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/dude_decomposer.hpp"
#include "regions/dude_division.hpp"
#include "regions/dude_pockets.hpp"

namespace occusg {
namespace {

/// Pockets nowhere deeper than this are not worth drawing.
constexpr double kMinPocketDepth_m = 0.3;
constexpr int kMaxPocketLevels = 32;

Segment2 segmentOf(const DudeCut& cut, const GridFrame& frame) {
  return {frame.corner(cut.a), frame.corner(cut.b)};
}

void addBridges(const CornerRing& ring, const GridFrame& frame, DudeTrace& trace) {
  for (const DudeBridge& bridge :
       pocketTree(ring, kMinPocketDepth_m / frame.resolution_m, kMaxPocketLevels)) {
    trace.bridges.push_back({{frame.corner(ring[bridge.first % ring.size()]),
                              frame.corner(ring[bridge.last % ring.size()])},
                             bridge.level});
  }
}

}  // namespace

DudeTrace DudeDivision::trace() const {
  const GridFrame& frame = regions_.decomposition().frame;
  DudeTrace trace;
  const DudeMask mask = dudeMask(open_, config_.max_ignored_hole_m / frame.resolution_m,
                                 [](const Cell& /*cell*/) { return true; });
  DudeCounters counters;
  DudeSteps steps;
  (void)partitioned(mask, mask.cells, rulesFor(frame), DudeOldCuts({}), counters, &steps);
  for (const CellOutline& outline : mask.outlines) addBridges(outline.outer, frame, trace);
  for (const CornerRing& hole : mask.ignored_holes)
    trace.ignored_holes.push_back(toPolygon({{hole.rbegin(), hole.rend()}, {}}, frame));
  for (const auto& [at, depth] : steps.minima)
    trace.minima.push_back({frame.corner(at), depth * frame.resolution_m});
  for (const Cell& at : steps.feet) trace.feet.push_back(frame.corner(at));
  for (const DudeCut& cut : steps.candidates)
    trace.candidates.push_back({segmentOf(cut, frame), cut.depth_cells * frame.resolution_m});
  for (const DudeCut& cut : regions_.cuts())
    trace.cuts.push_back({segmentOf(cut, frame), cut.depth_cells * frame.resolution_m});
  return trace;
}

}  // namespace occusg
