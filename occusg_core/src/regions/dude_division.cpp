// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_division.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "regions/dude_holes.hpp"

namespace occusg {
namespace {

/// A change this near to a cut may take its jambs away: both sides are divided again.
constexpr double kCutReach_m = 0.5;
/// How often the dirty regions may be found to need another before everything is recomputed.
constexpr int kMaxWidenings = 8;

bool holds(const std::vector<std::int32_t>& sorted, std::int32_t label) {
  return std::binary_search(sorted.begin(), sorted.end(), label);
}

void add(const std::vector<std::int32_t>& more, std::vector<std::int32_t>& sorted) {
  sorted.insert(sorted.end(), more.begin(), more.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
}

CellBox boundsOf(const DudeCut& cut) { return CellBox{}.including(cut.a).including(cut.b); }

template <typename Visitor>
void visitBox(const CellBox& box, Visitor visit) {
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) visit(Cell{x, y});
}

template <typename Visitor>
void visitNeighbours(const Cell& cell, Visitor visit) {
  visit(Cell{cell.x, cell.y - 1});
  visit(Cell{cell.x - 1, cell.y});
  visit(Cell{cell.x + 1, cell.y});
  visit(Cell{cell.x, cell.y + 1});
}

void keepLargest(DudeMask& mask) {
  const auto largest =
      std::max_element(mask.outlines.begin(), mask.outlines.end(),
                       [](const auto& a, const auto& b) { return cellCount(a) < cellCount(b); });
  if (largest != mask.outlines.end()) mask.outlines = {*largest};
}

}  // namespace

DudeDivision::DudeDivision(const DudeDecomposerConfig& config) : config_(checked(config)) {}

void DudeDivision::reset() {
  counters_ = {};
  open_ = {};
  regions_ = {};
}

const Decomposition& DudeDivision::update(const FreeSpace& layer, const CellBox& changed) {
  ++counters_.updates;
  const CellBox& box = layer.cells.box();
  const bool is_comparable =
      !open_.empty() && !layer.cells.empty() &&
      layer.frame.resolution_m == regions_.decomposition().frame.resolution_m &&
      box.including(open_.box()) == box;
  if (!is_comparable) {
    recompute(layer);
    return regions_.decomposition();
  }
  const bool has_grown = !(box == open_.box());
  if (has_grown) {
    open_.cover(box, 0);
    regions_.cover(box);
  }
  Dirty dirty = takeChanges(layer, has_grown ? box : changed);
  if (dirty.cells.empty()) return regions_.decomposition();
  if (config_.components == ComponentChoice::kLargest || !divideAgain(dirty)) recompute(layer);
  return regions_.decomposition();
}

DudePartitionRules DudeDivision::rulesFor(const GridFrame& frame) const {
  DudePartitionRules rules;
  rules.selection.depth_threshold_cells = config_.depth_threshold_m / frame.resolution_m;
  rules.selection.max_width_ratio = config_.max_width_ratio;
  rules.selection.min_area_cells =
      static_cast<std::int64_t>(std::ceil(config_.min_region_area_m2 / frame.cellArea()));
  rules.longest_cut_cells = config_.longest_cut_m / frame.resolution_m;
  rules.keep_bonus = config_.keep_bonus;
  return rules;
}

void DudeDivision::recompute(const FreeSpace& layer) {
  ++counters_.batch_updates;
  open_ = cleanedFreeSpace(layer.cells, layer.cells.box(), config_.cleaning);
  DudeMask mask = dudeMask(open_, config_.max_ignored_hole_m / layer.frame.resolution_m,
                           [](const Cell& /*cell*/) { return true; });
  counters_.ignored_holes += mask.ignored_holes.size();
  if (config_.components == ComponentChoice::kLargest) keepLargest(mask);
  regions_.assign(partitioned(mask, mask.cells, rulesFor(layer.frame), DudeOldCuts({}), counters_),
                  layer.frame);
}

DudeDivision::Dirty DudeDivision::takeChanges(const FreeSpace& layer, const CellBox& changed) {
  const CellBox box = changed.grown(cleaningReach(config_.cleaning)).intersected(layer.cells.box());
  const Grid<std::uint8_t> now = cleanedFreeSpace(layer.cells, box, config_.cleaning);
  Dirty dirty;
  std::vector<char> is_dirty(regions_.size() + 1, 0);
  visitBox(box, [&](const Cell& cell) {
    if (now.at(cell) == open_.at(cell)) return;
    open_.at(cell) = now.at(cell);
    dirty.cells.push_back(cell);
    visitBox(CellBox{}.including(cell).grown(1), [&](const Cell& near) {
      is_dirty[static_cast<std::size_t>(regions_.labels().valueOr(near, kNoRegion))] = 1;
    });
  });
  for (std::size_t label = 1; label < is_dirty.size(); ++label)
    if (is_dirty[label] != 0) dirty.labels.push_back(static_cast<std::int32_t>(label));
  return dirty;
}

void DudeDivision::addAcrossChangedCuts(Dirty& dirty) const {
  const int reach =
      static_cast<int>(std::ceil(kCutReach_m / regions_.decomposition().frame.resolution_m));
  CellBox changed;
  for (const Cell& cell : dirty.cells)
    if (!changed.contains(cell)) changed = changed.including(cell);
  std::vector<std::int32_t> more;
  for (const DudeCut& cut : regions_.cuts()) {
    const CellBox box = boundsOf(cut).grown(reach);
    if (box.intersected(changed).empty()) continue;
    const bool is_near = std::any_of(dirty.cells.begin(), dirty.cells.end(),
                                     [&](const Cell& cell) { return box.contains(cell); });
    if (is_near) more.insert(more.end(), {cut.label_a, cut.label_b});
  }
  add(more, dirty.labels);
}

void DudeDivision::addUnlabelledBeside(Dirty& dirty) const {
  std::set<Cell> found;
  std::vector<Cell> pending = dirty.cells;
  while (!pending.empty()) {
    const Cell cell = pending.back();
    pending.pop_back();
    visitNeighbours(cell, [&](const Cell& near) {
      if (open_.valueOr(near, 0) == 0 || regions_.labels().at(near) != kNoRegion) return;
      if (std::binary_search(dirty.cells.begin(), dirty.cells.end(), near)) return;
      if (found.insert(near).second) pending.push_back(near);
    });
  }
  std::vector<Cell> all;
  std::merge(dirty.cells.begin(), dirty.cells.end(), found.begin(), found.end(),
             std::back_inserter(all));
  dirty.cells = std::move(all);
}

bool DudeDivision::divideAgain(Dirty& dirty) {
  addAcrossChangedCuts(dirty);
  addUnlabelledBeside(dirty);
  for (int widening = 0; widening < kMaxWidenings; ++widening) {
    if (dirty.labels.size() == regions_.size()) return false;
    const DudeMask mask = dirtyMask(dirty);
    const std::vector<std::int32_t> missing = missingIn(mask, dirty);
    if (!missing.empty()) {
      add(missing, dirty.labels);
      continue;
    }
    std::vector<DudeCut> old_cuts;
    for (const DudeCut& cut : regions_.cuts()) {
      if (holds(dirty.labels, cut.label_a) && holds(dirty.labels, cut.label_b))
        old_cuts.push_back(cut);
    }
    counters_.ignored_holes += mask.ignored_holes.size();
    regions_.replace(dirty.labels, partitioned(mask, openRound(mask, dirty),
                                               rulesFor(regions_.decomposition().frame),
                                               DudeOldCuts(old_cuts), counters_));
    return true;
  }
  return false;
}

DudeMask DudeDivision::dirtyMask(const Dirty& dirty) const {
  CellBox box;
  for (const std::int32_t label : dirty.labels) box = box.including(regions_.box(label));
  for (const Cell& cell : dirty.cells)
    if (open_.at(cell) != 0 && !box.contains(cell)) box = box.including(cell);
  const auto isMine = [&](const Cell& cell) {
    const std::int32_t label = regions_.labels().at(cell);
    return label == kNoRegion || holds(dirty.labels, label);
  };
  Grid<std::uint8_t> cells(box, 0);
  visitBox(box, [&](const Cell& cell) {
    if (open_.at(cell) != 0 && isMine(cell)) cells.at(cell) = 1;
  });
  return dudeMask(std::move(cells),
                  config_.max_ignored_hole_m / regions_.decomposition().frame.resolution_m, isMine);
}

std::vector<std::int32_t> DudeDivision::missingIn(const DudeMask& mask, const Dirty& dirty) const {
  std::vector<std::int32_t> missing;
  const auto needNeighbours = [&](const Cell& cell) {
    visitNeighbours(cell, [&](const Cell& near) {
      const std::int32_t label = regions_.labels().valueOr(near, kNoRegion);
      if (label != kNoRegion && !holds(dirty.labels, label)) missing.push_back(label);
    });
  };
  // A piece too small to be a region has to join a neighbour.
  const std::int64_t min_area = rulesFor(regions_.decomposition().frame).selection.min_area_cells;
  for (const CellOutline& outline : mask.outlines)
    if (cellCount(outline) < min_area) visitRing(outline.outer, needNeighbours);
  // Furniture that a border runs through is no hole on either side.
  visitBox(mask.cells.box(), [&](const Cell& cell) {
    if (open_.at(cell) == 0 && mask.cells.at(cell) == 0 &&
        regions_.labels().at(cell) != kNoRegion && holds(dirty.labels, regions_.labels().at(cell)))
      needNeighbours(cell);
  });
  return missing;
}

Grid<std::uint8_t> DudeDivision::openRound(const DudeMask& mask, const Dirty& dirty) const {
  // Beyond half the longest cut no obstacle matters to a cut.
  const int margin = 1 + static_cast<int>(std::ceil(0.5 * config_.longest_cut_m /
                                                    regions_.decomposition().frame.resolution_m));
  Grid<std::uint8_t> open(mask.cells.box().grown(margin).intersected(open_.box()), 0);
  visitBox(open.box(), [&](const Cell& cell) {
    const std::int32_t label = regions_.labels().at(cell);
    const bool is_kept = label != kNoRegion && !holds(dirty.labels, label);
    open.at(cell) = is_kept || mask.cells.valueOr(cell, 0) != 0 ? 1 : 0;
  });
  return open;
}

}  // namespace occusg
