// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/cell_outline.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <map>
#include <utility>

namespace occusg {
namespace {

enum Direction { kEast, kNorth, kWest, kSouth };

constexpr Direction leftOf(Direction d) { return static_cast<Direction>((d + 1) % 4); }
constexpr Direction rightOf(Direction d) { return static_cast<Direction>((d + 3) % 4); }

/// The cells as bytes with a margin of one empty cell all round, so that no look-up needs a bounds
/// check. Corners and cells share one index: that of a corner is the cell to its upper right.
class PaddedCells {
 public:
  template <typename T, typename Predicate>
  PaddedCells(const Grid<T>& grid, const CellBox& box, Predicate is_inside)
      : box_(box),
        stride_(static_cast<std::size_t>(box.width()) + 2),
        inside_(stride_ * (static_cast<std::size_t>(box.height()) + 2), 0) {
    for (int y = box.min.y; y < box.max.y; ++y) {
      const T* source = &grid.at({box.min.x, y});
      std::uint8_t* target = &inside_[indexOf({box.min.x, y})];
      const std::ptrdiff_t width = box.width();
      for (std::ptrdiff_t x = 0; x < width; ++x) target[x] = is_inside(source[x]) ? 1 : 0;
    }
  }

  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] std::size_t size() const { return inside_.size(); }
  [[nodiscard]] bool inside(std::size_t index) const { return inside_[index] != 0; }
  [[nodiscard]] const std::uint8_t* data(std::size_t index) const { return &inside_[index]; }
  [[nodiscard]] std::size_t indexOf(const Cell& cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y + 1) * stride_ +
           static_cast<std::size_t>(cell.x - box_.min.x + 1);
  }

 private:
  CellBox box_;
  std::size_t stride_;
  std::vector<std::uint8_t> inside_;
};

/// A ring as walked: simple but for corners it passes twice.
struct WalkedRing {
  CornerRing corners;
  /// Positions in `corners` where the cells meet like a chessboard; only there a ring can meet
  /// itself.
  std::vector<std::size_t> pinches;
};

/// Cuts a ring into simple ones where it passes a corner twice.
std::vector<CornerRing> splitAtPinches(WalkedRing ring) {
  if (ring.pinches.empty()) return {std::move(ring.corners)};
  std::vector<CornerRing> simple;
  CornerRing open;
  std::map<Cell, std::size_t> position_in_open;
  auto next_pinch = ring.pinches.cbegin();
  for (std::size_t i = 0; i < ring.corners.size(); ++i) {
    const Cell& corner = ring.corners[i];
    if (next_pinch != ring.pinches.cend() && *next_pinch == i) {
      ++next_pinch;
      const auto [seen, is_new] = position_in_open.try_emplace(corner, open.size());
      if (!is_new) {
        const auto first = open.begin() + static_cast<std::ptrdiff_t>(seen->second);
        simple.emplace_back(first, open.end());
        open.erase(first, open.end());
      }
    }
    open.push_back(corner);
  }
  simple.push_back(std::move(open));
  return simple;
}

void startAtSmallestCorner(CornerRing& ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
}

/// Walks the cell edges with the inside on the left. Rings are found in row-major order of their
/// smallest corner: an outer ring by its lowest edge (going east), a hole by its lowest (going
/// west). The component a hole lies in is that of the next edge to its left, which is known by
/// then.
class OutlineTracer {
 public:
  explicit OutlineTracer(const PaddedCells& cells)
      : cells_(cells), walked_(cells.size(), 0), component_of_left_edge_(cells.size(), 0) {}

  std::vector<CellOutline> trace() {
    const CellBox& box = cells_.box();
    for (int y = box.min.y; y <= box.max.y; ++y) scanCornerRow(y);
    for (CellOutline& outline : outlines_) {
      std::sort(outline.holes.begin(), outline.holes.end(),
                [](const CornerRing& a, const CornerRing& b) { return a.front() < b.front(); });
    }
    return std::move(outlines_);
  }

 private:
  static constexpr std::uint8_t kBottomWalked = 1;
  static constexpr std::uint8_t kTopWalked = 2;

  /// Looks for edges between the cell rows y - 1 and y that no ring has passed yet.
  void scanCornerRow(int y) {
    const CellBox& box = cells_.box();
    const std::size_t row = cells_.indexOf({box.min.x, y});
    const std::size_t width = static_cast<std::size_t>(box.width());
    last_hole_index_ = 0;
    for (std::size_t i = 0; i < width; ++i) {
      while (i + 8 <= width && sameInBothRows(row + i)) i += 8;
      if (i == width) break;
      const std::size_t above = row + i;
      const std::size_t below = above - cells_.stride();
      const Cell corner{box.min.x + static_cast<int>(i), y};
      if (cells_.inside(above) && !cells_.inside(below)) {
        if ((walked_[above] & kBottomWalked) == 0) addOutline(corner);
      } else if (cells_.inside(below) && !cells_.inside(above)) {
        if ((walked_[below] & kTopWalked) == 0) addHole(corner, below);
      }
    }
  }

  /// Compares eight cells at once with those below them: most of a map is far from any edge.
  [[nodiscard]] bool sameInBothRows(std::size_t index) const {
    return std::memcmp(cells_.data(index), cells_.data(index - cells_.stride()), 8) == 0;
  }

  void addOutline(const Cell& start) {
    outlines_.emplace_back();
    const std::size_t component = outlines_.size() - 1;
    for (CornerRing& ring : splitAtPinches(walk(start, kEast, component))) {
      startAtSmallestCorner(ring);
      const bool is_outer = ring.front() == start;
      if (is_outer) {
        outlines_[component].outer = std::move(ring);
      } else {
        outlines_[component].holes.push_back(std::move(ring));
      }
    }
  }

  /// @param below index of the inside cell under the edge that starts one corner right of `corner`.
  void addHole(const Cell& corner, std::size_t below) {
    const std::size_t component = componentOf(below);
    for (CornerRing& ring : splitAtPinches(walk({corner.x + 1, corner.y}, kWest, component))) {
      startAtSmallestCorner(ring);
      outlines_[component].holes.push_back(std::move(ring));
    }
  }

  /// Goes left to the edge of the run of cells, or to where the last search of this row started.
  std::size_t componentOf(std::size_t cell) {
    std::size_t i = cell;
    while (i != last_hole_index_ && cells_.inside(i - 1)) --i;
    if (i != last_hole_index_) last_hole_component_ = component_of_left_edge_[i];
    last_hole_index_ = cell;
    return last_hole_component_;
  }

  WalkedRing walk(const Cell& start, Direction start_direction, std::size_t component) {
    static constexpr std::array<int, 4> kStepX{1, 0, -1, 0};
    static constexpr std::array<int, 4> kStepY{0, 1, 0, -1};
    // How far the cells left and right ahead lie before a corner's index, by direction of travel.
    const std::size_t stride = cells_.stride();
    const std::array<std::size_t, 4> left_ahead{0, 1, stride + 1, stride};
    const std::array<std::size_t, 4> right_ahead{stride, 0, 1, stride + 1};
    WalkedRing ring;
    Cell corner = start;
    Direction direction = start_direction;
    do {
      markEdge(cells_.indexOf(corner), direction, component);
      corner.x += kStepX[direction];
      corner.y += kStepY[direction];
      const std::size_t index = cells_.indexOf(corner);
      const bool left = cells_.inside(index - left_ahead[direction]);
      const bool right = cells_.inside(index - right_ahead[direction]);
      if (left && !right) continue;
      if (!left && right) ring.pinches.push_back(ring.corners.size());
      ring.corners.push_back(corner);
      // Turning left wherever possible keeps cells that meet at a corner only apart.
      direction = left ? rightOf(direction) : leftOf(direction);
    } while (corner != start || direction != start_direction);
    return ring;
  }

  /// @param index of the corner the edge leaves in `direction`.
  void markEdge(std::size_t index, Direction direction, std::size_t component) {
    const std::size_t stride = cells_.stride();
    if (direction == kEast) {
      walked_[index] |= kBottomWalked;
    } else if (direction == kWest) {
      walked_[index - stride - 1] |= kTopWalked;
    } else if (direction == kSouth) {
      component_of_left_edge_[index - stride] = static_cast<std::uint32_t>(component);
    }
  }

  const PaddedCells& cells_;
  std::vector<std::uint8_t> walked_;
  std::vector<std::uint32_t> component_of_left_edge_;
  std::size_t last_hole_index_ = 0;
  std::size_t last_hole_component_ = 0;
  std::vector<CellOutline> outlines_;
};

}  // namespace

std::vector<CellOutline> outlinesOf(const Grid<std::uint8_t>& mask) {
  if (mask.empty()) return {};
  const PaddedCells cells(mask, mask.box(), [](std::uint8_t value) { return value != 0; });
  return OutlineTracer(cells).trace();
}

std::vector<CellOutline> outlinesOf(const Grid<std::int32_t>& labels, std::int32_t label,
                                    const CellBox& box) {
  const CellBox known = box.intersected(labels.box());
  if (known.empty()) return {};
  const PaddedCells cells(labels, known, [label](std::int32_t value) { return value == label; });
  return OutlineTracer(cells).trace();
}

Polygon toPolygon(const CellOutline& outline, const GridFrame& frame) {
  const auto ringOf = [&frame](const CornerRing& corners) {
    Ring ring;
    ring.reserve(corners.size());
    for (const Cell& corner : corners) ring.push_back(frame.corner(corner));
    return ring;
  };
  Polygon polygon;
  polygon.outer = ringOf(outline.outer);
  polygon.holes.reserve(outline.holes.size());
  for (const CornerRing& hole : outline.holes) polygon.holes.push_back(ringOf(hole));
  return polygon;
}

}  // namespace occusg
