// SPDX-License-Identifier: BSD-3-Clause
#include "regions/constriction_division.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "regions/basin_regions.hpp"
#include "regions/crossings.hpp"
#include "regions/label_window.hpp"
#include "regions/small_pieces.hpp"

namespace occusg {
namespace {

/// The value of a piece in a list by piece.
template <typename Value>
Value& of(std::int32_t piece, std::vector<Value>& values) {
  const auto i = static_cast<std::size_t>(piece);
  if (i >= values.size()) values.resize(i + 1, 0);
  return values[i];
}

}  // namespace

ConstrictionDivision::ConstrictionDivision(const ConstrictionDecomposerConfig& config,
                                           std::uint64_t updates)
    : config_(config), pieces_(config) {
  decomposition_.update = updates;
}

const Decomposition& ConstrictionDivision::update(const FreeSpace& layer, const CellBox& changed) {
  decomposition_.frame = layer.frame;
  decomposition_.labels.cover(layer.cells.box(), kNoRegion);
  writeLabels(reorder(regroup(pieces_.update(layer, changed))));
  drawRegions();
  updateCrossings();
  ++decomposition_.update;
  return decomposition_;
}

std::size_t ConstrictionDivision::memoryBytes() const {
  return pieces_.memoryBytes() + decomposition_.labels.values().size() * sizeof(std::int32_t);
}

/// A piece of fewer cells is small.
std::int64_t ConstrictionDivision::minCells() const {
  return static_cast<std::int64_t>(cellsOf(config_.min_region_area_m2, decomposition_.frame));
}

/// Which piece has every small one in the end, or kNoRegion.
std::map<std::int32_t, std::int32_t> ConstrictionDivision::heirs() const {
  PieceNames involved = small_;
  for (const std::int32_t name : small_)
    for (const auto& [other, edges] : pieces_.pieces().at(name).shared) involved.insert(other);
  // Numbers count up with the first cell of a piece, so that ties do not depend on names.
  std::vector<std::pair<Cell, std::int32_t>> order;
  for (const std::int32_t name : involved)
    order.emplace_back(pieces_.pieces().at(name).sums.first, name);
  std::sort(order.begin(), order.end());
  std::map<std::int32_t, std::int32_t> number;
  for (const auto& [first, name] : order)
    number.emplace(name, static_cast<std::int32_t>(number.size()) + 1);
  std::vector<std::int64_t> cells{0};
  std::vector<SharedEdges> shared{{}};
  for (const auto& [first, name] : order) {
    const Piece& piece = pieces_.pieces().at(name);
    cells.push_back(piece.sums.count);
    SharedEdges& of_piece = shared.emplace_back();
    for (const auto& [other, edges] : piece.shared) {
      const auto found = number.find(other);
      if (found != number.end()) of_piece[found->second] = edges;
    }
  }
  const std::vector<std::int32_t> heir =
      heirsOfSmallPieces(std::move(cells), std::move(shared), minCells());
  std::map<std::int32_t, std::int32_t> heirs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::int32_t into = heir[i + 1];
    if (small_.count(order[i].second) > 0)
      heirs[order[i].second] = into == kNoRegion ? kNoRegion : order[into - 1].second;
  }
  return heirs;
}

std::int32_t ConstrictionDivision::groupOf(std::int32_t piece) const {
  if (pieces_.pieces().count(piece) == 0) return kNoRegion;
  const auto heir = heirs_.find(piece);
  return heir == heirs_.end() ? piece : heir->second;
}

/// Brings small pieces and their heirs up to date. @return the pieces that changed, are gone, or
/// belong to another group now.
ConstrictionDivision::PieceNames ConstrictionDivision::movedPieces(const PieceChanges& changes) {
  PieceNames moved = changes.gone;
  moved.insert(changes.touched.begin(), changes.touched.end());
  for (const std::int32_t piece : changes.gone) small_.erase(piece);
  for (const std::int32_t piece : changes.touched) {
    if (pieces_.pieces().at(piece).sums.count < minCells()) {
      small_.insert(piece);
    } else {
      small_.erase(piece);
    }
  }
  heirs_ = heirs();
  for (const auto& [piece, heir] : heirs_)
    if (of(piece, group_of_piece_) != heir) moved.insert(piece);
  return moved;
}

/// Brings the groups up to date. @return the names of those that are new, changed or gone.
ConstrictionDivision::PieceNames ConstrictionDivision::regroup(const PieceChanges& changes) {
  PieceNames members = movedPieces(changes);
  PieceNames changed;
  for (const std::int32_t piece : members) {
    changed.insert(of(piece, group_of_piece_));
    changed.insert(groupOf(piece));
  }
  changed.erase(kNoRegion);
  for (const std::int32_t name : changed) {
    const auto group = groups_.find(name);
    if (group == groups_.end()) continue;
    members.insert(group->second.pieces.begin(), group->second.pieces.end());
    groups_.erase(group);
  }
  for (const std::int32_t name : members) {
    const std::int32_t into = groupOf(name);
    of(name, group_of_piece_) = into;
    of(name, id_of_piece_) = 0;
    if (into == kNoRegion) continue;
    const Piece& piece = pieces_.pieces().at(name);
    Group& group = groups_[into];
    group.pieces.push_back(name);
    group.sums.add(piece.sums);
    group.squared_depth = std::max(group.squared_depth, piece.squared_depth);
  }
  return changed;
}

bool ConstrictionDivision::isTooNarrow(const Group& group) const {
  const double min_width_cells = config_.min_room_width_m / decomposition_.frame.resolution_m;
  return 2.0 * std::sqrt(group.squared_depth) < min_width_cells;
}

/// Numbers the regions by their first cells. @return boxes that hold every cell whose label is
/// another one now.
std::vector<CellBox> ConstrictionDivision::reorder(const PieceNames& changed) {
  std::vector<CellBox> boxes;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    order_[i].old_id = static_cast<int>(i) + 1;
    if (changed.count(order_[i].group) > 0) boxes.push_back(decomposition_.regions[i].cells);
  }
  order_.erase(std::remove_if(order_.begin(), order_.end(),
                              [&](const Place& place) { return changed.count(place.group) > 0; }),
               order_.end());
  const auto kept = static_cast<std::ptrdiff_t>(order_.size());
  for (const std::int32_t name : changed) {
    const auto group = groups_.find(name);
    if (group == groups_.end() || isTooNarrow(group->second)) continue;
    order_.push_back({group->second.sums.first, name, 0});
  }
  std::sort(order_.begin() + kept, order_.end());
  std::inplace_merge(order_.begin(), order_.begin() + kept, order_.end());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const int id = static_cast<int>(i) + 1;
    if (order_[i].old_id == id) continue;
    const Group& group = groups_.at(order_[i].group);
    boxes.push_back(group.sums.bounds);
    for (const std::int32_t piece : group.pieces) of(piece, id_of_piece_) = id;
  }
  return boxes;
}

void ConstrictionDivision::writeLabels(const std::vector<CellBox>& boxes) {
  for (const CellBox& box : boxes) {
    const Grid<std::int32_t> pieces = pieces_.cells().dense(box);
    auto piece = pieces.values().begin();
    for (int y = box.min.y; y < box.max.y; ++y, piece += box.width()) {
      std::transform(piece, piece + box.width(), &decomposition_.labels.at({box.min.x, y}),
                     [&](std::int32_t name) {
                       return name == kNoRegion ? 0 : id_of_piece_[static_cast<std::size_t>(name)];
                     });
    }
  }
}

/// Lists the regions in their order; those whose cells are the same are not drawn again.
void ConstrictionDivision::drawRegions() {
  std::vector<Region> regions;
  regions.reserve(order_.size());
  decomposition_.same_as.clear();
  for (const Place& place : order_) {
    const int id = static_cast<int>(regions.size()) + 1;
    decomposition_.same_as.push_back(place.old_id);
    if (place.old_id == 0) {
      regions.push_back(regionOf(decomposition_.labels, id, id, decomposition_.frame,
                                 groups_.at(place.group).sums));
    } else {
      regions.push_back(
          std::move(decomposition_.regions[static_cast<std::size_t>(place.old_id) - 1]));
      regions.back().id = id;
    }
  }
  decomposition_.regions = std::move(regions);
}

/// Finds the crossings of new regions, keeps those between others, and names the regions beside
/// each other.
void ConstrictionDivision::updateCrossings() {
  std::vector<int> new_id;
  for (std::size_t i = 0; i < order_.size(); ++i)
    of(order_[i].old_id, new_id) = order_[i].old_id == 0 ? 0 : static_cast<int>(i) + 1;
  std::vector<Crossing> crossings;
  for (const Crossing& crossing : decomposition_.crossings) {
    const int a = of(crossing.region_a, new_id);
    const int b = of(crossing.region_b, new_id);
    if (a != 0 && b != 0) crossings.push_back({std::min(a, b), std::max(a, b), crossing.segment});
  }
  for (const Crossing& crossing : crossingsOfNewRegions()) crossings.push_back(crossing);
  sortByRegions(crossings);
  decomposition_.crossings = std::move(crossings);
  nameNeighbours(decomposition_.crossings, decomposition_.regions);
}

std::vector<Crossing> ConstrictionDivision::crossingsOfNewRegions() const {
  std::vector<Crossing> crossings;
  std::set<int> done;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    if (order_[i].old_id != 0) continue;
    const int id = static_cast<int>(i) + 1;
    const CellBox box =
        decomposition_.regions[i].cells.grown(1).intersected(decomposition_.labels.box());
    const Grid<std::int32_t> labels = labelsOver(box, decomposition_.labels);
    for (const Crossing& crossing :
         crossingsOf(labels, decomposition_.frame, config_.min_crossing_m)) {
      if (crossing.region_a != id && crossing.region_b != id) continue;
      const int other = crossing.region_a == id ? crossing.region_b : crossing.region_a;
      if (done.count(other) == 0) crossings.push_back(crossing);
    }
    done.insert(id);
  }
  return crossings;
}

}  // namespace occusg
