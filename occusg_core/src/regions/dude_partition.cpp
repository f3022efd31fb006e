// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_partition.hpp"

#include <algorithm>
#include <cstdlib>

#include "regions/dude_candidates.hpp"
#include "regions/dude_holes.hpp"
#include "regions/dude_mesh.hpp"
#include "regions/dude_pieces.hpp"
#include "regions/dude_symmetry.hpp"

namespace occusg {
namespace {

/// How far the end of a cut may have moved for the cut to count as the same.
constexpr int kSameEnd_cells = 4;

std::pair<Cell, Cell> ordered(const Cell& a, const Cell& b) {
  return a < b ? std::make_pair(a, b) : std::make_pair(b, a);
}

bool isNear(const Cell& a, const Cell& b) {
  return std::abs(a.x - b.x) <= kSameEnd_cells && std::abs(a.y - b.y) <= kSameEnd_cells;
}

/// One component in its canonical place.
class ComponentDivider {
 public:
  ComponentDivider(const CellOutline& outline, const Grid<std::uint8_t>& open,
                   const Grid<std::int32_t>& clearance, const DudePartitionRules& rules,
                   const DudeOldCuts& old_cuts)
      : rules_(rules),
        old_cuts_(old_cuts),
        to_canonical_(canonicalSymmetry(outline)),
        to_map_(to_canonical_.inverse()),
        surroundings_(open, clearance, to_map_),
        shape_(shapeOf(to_canonical_.outline(outline), surroundings_, rules.longest_cut_cells)),
        mesh_(triangulated(shape_.rings)),
        candidates_(cutCandidates(mesh_, shape_, surroundings_, rules.longest_cut_cells)) {}

  /// Adds the component's pieces and cuts to `partition`.
  void divide(DudePartition& partition) const {
    const DudeFlood flood = floodedPieces(mesh_, candidates_);
    Grid<std::int32_t> values = rasterised(mesh_, flood);
    const std::vector<DudeLink> links = linksOf(flood);
    const DudeSelection selection =
        selectCuts(measured(values, flood.count), links, rules_.selection);
    for (std::int32_t& value : values.values())
      if (value >= 0) value = selection.merged_piece[static_cast<std::size_t>(value)];
    const std::vector<std::int32_t> label_of_value = place(selection.count, values, partition);
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (selection.is_kept[i] == 0) continue;
      DudeCut cut = cutOf(candidates_[i]);
      cut.label_a = label_of_value[static_cast<std::size_t>(
          selection.merged_piece[static_cast<std::size_t>(links[i].piece_a)])];
      cut.label_b = label_of_value[static_cast<std::size_t>(
          selection.merged_piece[static_cast<std::size_t>(links[i].piece_b)])];
      if (cut.label_a > cut.label_b) std::swap(cut.label_a, cut.label_b);
      if (cut.label_a > 0 && cut.label_a != cut.label_b) partition.cuts.push_back(cut);
    }
  }

  void describe(DudeSteps& steps) const {
    for (std::size_t i = 0; i < shape_.corners.size(); ++i) {
      const DudeCorner& corner = shape_.corners[i];
      const Cell at = to_map_.corner(mesh_.points[i]);
      if (corner.is_minimum) steps.minima.emplace_back(at, corner.depth_cells);
      if (corner.is_foot) steps.feet.push_back(at);
    }
    for (const DudeCandidate& candidate : candidates_) steps.candidates.push_back(cutOf(candidate));
  }

  void count(DudeCounters& counters) const {
    ++counters.components;
    counters.corners += mesh_.points.size();
    counters.candidates += candidates_.size();
  }

 private:
  [[nodiscard]] DudeCut cutOf(const DudeCandidate& candidate) const {
    const auto [a, b] =
        ordered(to_map_.corner(mesh_.points[static_cast<std::size_t>(candidate.corner_a)]),
                to_map_.corner(mesh_.points[static_cast<std::size_t>(candidate.corner_b)]));
    return {a, b, 0, 0, candidate.depth_cells};
  }

  [[nodiscard]] std::vector<DudeLink> linksOf(const DudeFlood& flood) const {
    std::vector<DudeLink> links;
    links.reserve(candidates_.size());
    for (const DudeCandidate& candidate : candidates_) {
      const auto face = static_cast<std::size_t>(candidate.face);
      const int other = mesh_.faces[face].neighbours[static_cast<std::size_t>(candidate.side)];
      const DudeCut cut = cutOf(candidate);
      links.push_back({flood.piece_of_face[face],
                       flood.piece_of_face[static_cast<std::size_t>(other)], candidate.length_cells,
                       candidate.depth_cells,
                       old_cuts_.has(cut.a, cut.b) ? rules_.keep_bonus : 0.0});
    }
    return links;
  }

  [[nodiscard]] std::vector<DudePiece> measured(const Grid<std::int32_t>& values, int count) const {
    std::vector<DudePiece> pieces(static_cast<std::size_t>(count));
    std::vector<std::int32_t> squared(static_cast<std::size_t>(count), 0);
    for (int y = values.box().min.y; y < values.box().max.y; ++y) {
      for (int x = values.box().min.x; x < values.box().max.x; ++x) {
        const std::int32_t value = values.at({x, y});
        if (value < 0) continue;
        std::int32_t& largest = squared[static_cast<std::size_t>(value)];
        largest = std::max(largest, surroundings_.squaredClearance({x, y}));
        ++pieces[static_cast<std::size_t>(value)].area_cells;
      }
    }
    for (std::size_t i = 0; i < pieces.size(); ++i)
      pieces[i].radius_cells = DudeSurroundings::radius(squared[i]);
    return pieces;
  }

  /// Writes the pieces to the map. @return the label of every value; 0 for those without a cell.
  std::vector<std::int32_t> place(int count, Grid<std::int32_t>& values,
                                  DudePartition& partition) const {
    if (count > 1) count = joinCrumbs(count, values);
    std::vector<std::int32_t> labels(static_cast<std::size_t>(count), 0);
    for (int y = values.box().min.y; y < values.box().max.y; ++y) {
      for (int x = values.box().min.x; x < values.box().max.x; ++x) {
        const std::int32_t value = values.at({x, y});
        if (value < 0) continue;
        std::int32_t& label = labels[static_cast<std::size_t>(value)];
        if (label == 0) {
          partition.boxes.emplace_back();
          label = partition.count();
        }
        const Cell cell = to_map_.cell({x, y});
        CellBox& box = partition.boxes[static_cast<std::size_t>(label - 1)];
        if (!box.contains(cell)) box = box.including(cell);
        partition.labels.at(cell) = label;
      }
    }
    return labels;
  }

  const DudePartitionRules& rules_;
  const DudeOldCuts& old_cuts_;
  GridSymmetry to_canonical_;
  GridSymmetry to_map_;
  DudeSurroundings surroundings_;
  DudeShape shape_;
  DudeMesh mesh_;
  std::vector<DudeCandidate> candidates_;
};

}  // namespace

DudeOldCuts::DudeOldCuts(const std::vector<DudeCut>& cuts) {
  ends_.reserve(cuts.size());
  for (const DudeCut& cut : cuts) ends_.push_back(ordered(cut.a, cut.b));
  std::sort(ends_.begin(), ends_.end());
}

bool DudeOldCuts::has(const Cell& a, const Cell& b) const {
  const auto [low, high] = ordered(a, b);
  for (int dy = -kSameEnd_cells; dy <= kSameEnd_cells; ++dy) {
    // Rows of the smaller end: within each, cuts are sorted by x.
    const Cell from{low.x - kSameEnd_cells, low.y + dy};
    auto cut = std::lower_bound(ends_.begin(), ends_.end(), std::make_pair(from, Cell{}),
                                [](const auto& p, const auto& q) { return p.first < q.first; });
    for (; cut != ends_.end() && isNear(cut->first, low) && cut->first.y == from.y; ++cut)
      if (isNear(cut->second, high)) return true;
  }
  return false;
}

std::int64_t cellCount(const CellOutline& outline) {
  std::int64_t cells = signedCells(outline.outer);
  for (const CornerRing& hole : outline.holes) cells += signedCells(hole);
  return cells;
}

DudePartition partitioned(const DudeMask& mask, const Grid<std::uint8_t>& open,
                          const DudePartitionRules& rules, const DudeOldCuts& old_cuts,
                          DudeCounters& counters, DudeSteps* steps) {
  DudePartition partition{Grid<std::int32_t>(mask.cells.box(), 0), {}, {}};
  const Grid<std::int32_t> clearance = squaredClearance(open);
  for (const CellOutline& outline : mask.outlines) {
    if (cellCount(outline) < rules.selection.min_area_cells) continue;
    const ComponentDivider divider(outline, open, clearance, rules, old_cuts);
    divider.divide(partition);
    divider.count(counters);
    if (steps != nullptr) divider.describe(*steps);
  }
  counters.cuts += partition.cuts.size();
  return partition;
}

}  // namespace occusg
