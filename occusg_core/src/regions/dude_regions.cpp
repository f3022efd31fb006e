// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_regions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "geometry/cell_outline.hpp"

namespace occusg {
namespace {

/// How far beside a cut its sides are looked up: past the cells its line runs through.
constexpr double kBesideCut_cells = 0.75;

bool isEarlierCut(const DudeCut& a, const DudeCut& b) {
  return std::tie(a.label_a, a.label_b, a.a, a.b) < std::tie(b.label_a, b.label_b, b.a, b.b);
}

std::size_t indexOf(std::int32_t label) { return static_cast<std::size_t>(label - 1); }

/// The pair of regions that meet most often along a cut; both 0 when none do.
std::pair<std::int32_t, std::int32_t> sidesOf(const DudeCut& cut,
                                              const Grid<std::int32_t>& labels) {
  const double dx = cut.b.x - cut.a.x;
  const double dy = cut.b.y - cut.a.y;
  const double length = std::hypot(dx, dy);
  const double beside_x = -dy / length * kBesideCut_cells;
  const double beside_y = dx / length * kBesideCut_cells;
  std::map<std::pair<std::int32_t, std::int32_t>, int> meetings;
  for (double along = 0.5; along < length; along += 1.0) {
    const double x = cut.a.x + dx * along / length;
    const double y = cut.a.y + dy * along / length;
    const auto labelAt = [&](double at_x, double at_y) {
      return labels.valueOr(
          {static_cast<int>(std::floor(at_x)), static_cast<int>(std::floor(at_y))}, kNoRegion);
    };
    const std::int32_t left = labelAt(x + beside_x, y + beside_y);
    const std::int32_t right = labelAt(x - beside_x, y - beside_y);
    if (left != right && left != kNoRegion && right != kNoRegion)
      ++meetings[std::minmax(left, right)];
  }
  const auto best =
      std::max_element(meetings.begin(), meetings.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == meetings.end() ? std::make_pair(kNoRegion, kNoRegion) : best->first;
}

}  // namespace

void DudeRegions::assign(DudePartition partition, const GridFrame& frame) {
  decomposition_ = Decomposition{frame, {}, {}, std::move(partition.labels)};
  decomposition_.regions.resize(partition.boxes.size());
  for (std::size_t i = 0; i < partition.boxes.size(); ++i) {
    decomposition_.regions[i].cells = partition.boxes[i];
    describe(static_cast<std::int32_t>(i + 1));
  }
  cuts_ = std::move(partition.cuts);
  std::sort(cuts_.begin(), cuts_.end(), isEarlierCut);
  link(std::vector<char>(size(), 1));
}

void DudeRegions::replace(const std::vector<std::int32_t>& replaced,
                          const DudePartition& partition) {
  const std::size_t old_size = size();
  erase(replaced);
  const std::vector<std::int32_t> placed = place(replaced, partition);
  std::vector<std::int32_t> gaps;
  if (placed.size() < replaced.size())
    gaps.assign(replaced.begin() + static_cast<std::ptrdiff_t>(placed.size()), replaced.end());
  const std::vector<Move> moves = closeGaps(std::move(gaps));
  AffectedCuts affected = takeAffectedCuts(replaced, moves, old_size);
  std::vector<DudeCut>& changed = affected.remaining;
  for (DudeCut cut : partition.cuts) {
    std::tie(cut.label_a, cut.label_b) =
        std::minmax(placed[indexOf(cut.label_a)], placed[indexOf(cut.label_b)]);
    changed.push_back(cut);
  }
  std::vector<char> is_touched(size(), 0);
  for (const DudeCut& cut : changed)
    is_touched[indexOf(cut.label_a)] = is_touched[indexOf(cut.label_b)] = 1;
  for (const std::int32_t label : affected.neighbours) is_touched[indexOf(label)] = 1;
  for (const std::int32_t label : placed) {
    describe(label);
    is_touched[indexOf(label)] = 1;
  }
  std::sort(changed.begin(), changed.end(), isEarlierCut);
  const auto old_count = static_cast<std::ptrdiff_t>(cuts_.size());
  cuts_.insert(cuts_.end(), changed.begin(), changed.end());
  std::inplace_merge(cuts_.begin(), cuts_.begin() + old_count, cuts_.end(), isEarlierCut);
  link(is_touched);
}

void DudeRegions::erase(const std::vector<std::int32_t>& replaced) {
  for (const std::int32_t label : replaced) {
    const CellBox cells = box(label);
    for (int y = cells.min.y; y < cells.max.y; ++y) {
      for (int x = cells.min.x; x < cells.max.x; ++x)
        if (std::int32_t& at = decomposition_.labels.at({x, y}); at == label) at = kNoRegion;
    }
  }
}

std::vector<std::int32_t> DudeRegions::place(const std::vector<std::int32_t>& replaced,
                                             const DudePartition& partition) {
  std::vector<std::int32_t> placed;
  for (std::size_t i = 0; i < partition.boxes.size(); ++i) {
    if (i >= replaced.size()) decomposition_.regions.emplace_back();
    placed.push_back(i < replaced.size() ? replaced[i] : static_cast<std::int32_t>(size()));
    decomposition_.regions[indexOf(placed.back())].cells = partition.boxes[i];
  }
  const CellBox& cells = partition.labels.box();
  for (int y = cells.min.y; y < cells.max.y; ++y) {
    for (int x = cells.min.x; x < cells.max.x; ++x) {
      if (const std::int32_t label = partition.labels.at({x, y}); label != kNoRegion)
        decomposition_.labels.at({x, y}) = placed[indexOf(label)];
    }
  }
  return placed;
}

std::vector<DudeRegions::Move> DudeRegions::closeGaps(std::vector<std::int32_t> gaps) {
  std::vector<Move> moves;
  std::size_t filled = 0;
  while (filled < gaps.size()) {
    const auto last = static_cast<std::int32_t>(size());
    if (gaps.back() == last) {
      gaps.pop_back();
    } else {
      // New regions lie below the gaps, so it is an old one that moves.
      const std::int32_t gap = gaps[filled++];
      moves.emplace_back(last, gap);
      const CellBox cells = box(last);
      for (int y = cells.min.y; y < cells.max.y; ++y) {
        for (int x = cells.min.x; x < cells.max.x; ++x)
          if (std::int32_t& at = decomposition_.labels.at({x, y}); at == last) at = gap;
      }
      decomposition_.regions[indexOf(gap)] = std::move(decomposition_.regions.back());
      decomposition_.regions[indexOf(gap)].id = gap;
    }
    decomposition_.regions.pop_back();
  }
  return moves;
}

DudeRegions::AffectedCuts DudeRegions::takeAffectedCuts(const std::vector<std::int32_t>& replaced,
                                                        const std::vector<Move>& moves,
                                                        std::size_t old_size) {
  // What the regions of before are called now; 0: replaced.
  std::vector<std::int32_t> now(old_size);
  std::iota(now.begin(), now.end(), 1);
  for (const Move& move : moves) now[indexOf(move.first)] = move.second;
  for (const std::int32_t label : replaced) now[indexOf(label)] = kNoRegion;
  AffectedCuts affected;
  const auto take = [&](const DudeCut& cut) {
    const std::int32_t a = now[indexOf(cut.label_a)];
    const std::int32_t b = now[indexOf(cut.label_b)];
    if (a == cut.label_a && b == cut.label_b) return false;
    if (a != kNoRegion) affected.neighbours.push_back(a);
    if (b != kNoRegion) affected.neighbours.push_back(b);
    if (a == kNoRegion && b == kNoRegion) return true;
    DudeCut remaining = cut;
    std::tie(remaining.label_a, remaining.label_b) = sidesOf(cut, decomposition_.labels);
    if (remaining.label_a != kNoRegion) affected.remaining.push_back(remaining);
    return true;
  };
  cuts_.erase(std::remove_if(cuts_.begin(), cuts_.end(), take), cuts_.end());
  return affected;
}

void DudeRegions::describe(std::int32_t label) {
  Region& region = decomposition_.regions[indexOf(label)];
  const GridFrame& frame = decomposition_.frame;
  region.id = label;
  const std::vector<CellOutline> outlines = outlinesOf(decomposition_.labels, label, region.cells);
  // Pieces are 4-connected: there is one outline.
  region.polygon = toPolygon(outlines.front(), frame);
  region.area_m2 = static_cast<double>(cellCount(outlines.front())) * frame.cellArea();
  region.centroid = centroid(region.polygon);
}

void DudeRegions::link(const std::vector<char>& is_touched) {
  std::vector<Region>& regions = decomposition_.regions;
  const auto connect = [&](std::int32_t from, std::int32_t to) {
    if (is_touched[indexOf(from)] != 0) regions[indexOf(from)].adjacent.push_back(to);
  };
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (is_touched[i] != 0) regions[i].adjacent.clear();
  decomposition_.crossings.clear();
  for (const DudeCut& cut : cuts_) {
    connect(cut.label_a, cut.label_b);
    connect(cut.label_b, cut.label_a);
    const GridFrame& frame = decomposition_.frame;
    decomposition_.crossings.push_back(
        {cut.label_a, cut.label_b, {frame.corner(cut.a), frame.corner(cut.b)}});
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (is_touched[i] == 0) continue;
    std::vector<int>& adjacent = regions[i].adjacent;
    std::sort(adjacent.begin(), adjacent.end());
    adjacent.erase(std::unique(adjacent.begin(), adjacent.end()), adjacent.end());
  }
}

}  // namespace occusg
