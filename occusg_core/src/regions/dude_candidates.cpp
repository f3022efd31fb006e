// SPDX-License-Identifier: BSD-3-Clause
#include "regions/dude_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "regions/dude_holes.hpp"
#include "regions/dude_pockets.hpp"

namespace occusg {
namespace {

/// How far the clearance of the cell round a cut's middle may fall short of half its length: the
/// middle need not be the middle of a cell.
constexpr double kClearanceTolerance_cells = 1.0;

/// A corner to be added in the middle of a straight edge.
struct Foot {
  bool on_vertical_edge = false;
  int line = 0;      ///< Common coordinate of the edge.
  int position = 0;  ///< Where on the edge.
  friend bool operator<(const Foot& a, const Foot& b) {
    return std::tie(a.on_vertical_edge, a.line, a.position) <
           std::tie(b.on_vertical_edge, b.line, b.position);
  }
  friend bool operator==(const Foot& a, const Foot& b) { return !(a < b) && !(b < a); }
};

/// The one closed cell of the four round a corner, as its offset from the corner.
struct ClosedCell {
  bool exists = false;
  int dx = 0;
  int dy = 0;
};

ClosedCell onlyClosedCell(const Cell& corner, const DudeSurroundings& surroundings) {
  ClosedCell found;
  int closed = 0;
  for (int dy = -1; dy <= 0; ++dy) {
    for (int dx = -1; dx <= 0; ++dx) {
      if (surroundings.isOpen({corner.x + dx, corner.y + dy})) continue;
      found = {true, dx, dy};
      ++closed;
    }
  }
  return closed == 1 ? found : ClosedCell{};
}

bool isLocallyNarrowest(const Cell& a, const Cell& b, const DudeSurroundings& surroundings) {
  const double half_length = 0.5 * std::hypot(b.x - a.x, b.y - a.y);
  const auto half_down = [](int sum) { return sum >= 0 ? sum / 2 : -((1 - sum) / 2); };
  const Cell middle{half_down(a.x + b.x), half_down(a.y + b.y)};
  return DudeSurroundings::radius(surroundings.squaredClearance(middle)) +
             kClearanceTolerance_cells >=
         half_length;
}

/// Goes straight on from a minimum until free space ends.
class FootFinder {
 public:
  FootFinder(const DudeSurroundings& surroundings, double longest_cut_cells)
      : surroundings_(surroundings), longest_(static_cast<int>(longest_cut_cells)) {}

  void look(const Cell& from, const ClosedCell& closed, std::vector<Foot>& feet) const {
    lookAlong(from, closed.dx == 0 ? -1 : 1, 0, feet);
    lookAlong(from, 0, closed.dy == 0 ? -1 : 1, feet);
  }

 private:
  void lookAlong(const Cell& from, int step_x, int step_y, std::vector<Foot>& feet) const {
    Cell at = from;
    for (int length = 0; length <= longest_; ++length) {
      // The cells ahead, on either side of the line.
      const Cell upper{at.x + std::min(step_x, 0), at.y + std::min(step_y, 0)};
      const Cell lower{upper.x - std::abs(step_y), upper.y - std::abs(step_x)};
      const bool upper_open = surroundings_.isOpen(upper);
      const bool lower_open = surroundings_.isOpen(lower);
      if (upper_open && lower_open) {
        at = {at.x + step_x, at.y + step_y};
        continue;
      }
      // One closed cell alone has a corner here already.
      if (upper_open || lower_open || !isLocallyNarrowest(from, at, surroundings_)) return;
      feet.push_back(step_x != 0 ? Foot{true, at.x, at.y} : Foot{false, at.y, at.x});
      return;
    }
  }

  const DudeSurroundings& surroundings_;
  int longest_;
};

/// The feet on the edge a-b, in the order in which the edge is walked.
std::vector<Cell> feetOn(const Cell& a, const Cell& b, const std::vector<Foot>& feet) {
  const bool vertical = a.x == b.x;
  const int line = vertical ? a.x : a.y;
  const int from = vertical ? std::min(a.y, b.y) : std::min(a.x, b.x);
  const int to = vertical ? std::max(a.y, b.y) : std::max(a.x, b.x);
  const auto first = std::upper_bound(feet.begin(), feet.end(), Foot{vertical, line, from});
  const auto last = std::lower_bound(first, feet.end(), Foot{vertical, line, to});
  std::vector<Cell> cells;
  for (auto foot = first; foot != last; ++foot)
    cells.push_back(vertical ? Cell{line, foot->position} : Cell{foot->position, line});
  if (a < b) return cells;
  std::reverse(cells.begin(), cells.end());
  return cells;
}

void addRing(const CornerRing& ring, const std::vector<double>& depths,
             const std::vector<char>& is_minimum, const std::vector<Foot>& feet, DudeShape& shape) {
  CornerRing with_feet;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    with_feet.push_back(ring[i]);
    shape.corners.push_back({is_minimum[i] != 0, false, depths[i]});
    for (const Cell& foot : feetOn(ring[i], ring[(i + 1) % ring.size()], feet)) {
      with_feet.push_back(foot);
      shape.corners.push_back({false, true, 0.0});
    }
  }
  shape.rings.push_back(std::move(with_feet));
}

/// True when `corner` is strictly outside the circle that has a-b as its diameter.
bool isOutsideCircle(const Cell& a, const Cell& b, const Cell& corner) {
  return static_cast<std::int64_t>(a.x - corner.x) * (b.x - corner.x) +
             static_cast<std::int64_t>(a.y - corner.y) * (b.y - corner.y) >
         0;
}

/// The corner of `face` that is neither a nor b.
int apexAcross(const DudeMesh& mesh, int face, int a, int b) {
  const std::array<int, 3>& corners = mesh.faces[static_cast<std::size_t>(face)].corners;
  for (const int corner : corners)
    if (corner != a && corner != b) return corner;
  return corners[0];
}

bool mayBeCut(const DudeCorner& a, const DudeCorner& b) {
  return (a.is_minimum && (b.is_minimum || b.is_foot)) || (a.is_foot && b.is_minimum);
}

}  // namespace

double DudeSurroundings::radius(std::int32_t squared_clearance) {
  // Distances are between the middles of cells, the obstacle's edge is half a cell nearer.
  return squared_clearance == 0 ? 0.0 : std::sqrt(static_cast<double>(squared_clearance)) - 0.5;
}

DudeShape shapeOf(const CellOutline& outline, const DudeSurroundings& surroundings,
                  double longest_cut_cells) {
  const FootFinder finder(surroundings, longest_cut_cells);
  std::vector<const CornerRing*> rings{&outline.outer};
  for (const CornerRing& hole : outline.holes) rings.push_back(&hole);
  std::vector<Foot> feet;
  std::vector<std::vector<char>> is_minimum;
  for (const CornerRing* ring : rings) {
    std::vector<char>& flags = is_minimum.emplace_back();
    for (const Cell& corner : *ring) {
      const ClosedCell closed = onlyClosedCell(corner, surroundings);
      flags.push_back(closed.exists ? 1 : 0);
      if (closed.exists) finder.look(corner, closed, feet);
    }
  }
  std::sort(feet.begin(), feet.end());
  feet.erase(std::unique(feet.begin(), feet.end()), feet.end());
  DudeShape shape;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    addRing(*rings[i], i == 0 ? pocketDepths(*rings[i]) : holeDepths(*rings[i]), is_minimum[i],
            feet, shape);
  }
  return shape;
}

std::vector<DudeCandidate> cutCandidates(const DudeMesh& mesh, const DudeShape& shape,
                                         const DudeSurroundings& surroundings,
                                         double longest_cut_cells) {
  const auto corner = [&](int i) -> const DudeCorner& {
    return shape.corners[static_cast<std::size_t>(i)];
  };
  const auto point = [&](int i) -> const Cell& { return mesh.points[static_cast<std::size_t>(i)]; };
  std::vector<DudeCandidate> candidates;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
    for (std::size_t side = 0; side < 3; ++side) {
      const int other = mesh.faces[face].neighbours[side];
      if (other < static_cast<int>(face)) continue;
      const int a = mesh.faces[face].corners[(side + 1) % 3];
      const int b = mesh.faces[face].corners[(side + 2) % 3];
      if (!mayBeCut(corner(a), corner(b))) continue;
      const double length = std::hypot(point(b).x - point(a).x, point(b).y - point(a).y);
      if (length > longest_cut_cells) continue;
      // With the two apexes outside the circle, the Delaunay property keeps all others out.
      if (!isOutsideCircle(point(a), point(b), point(mesh.faces[face].corners[side]))) continue;
      if (!isOutsideCircle(point(a), point(b), point(apexAcross(mesh, other, a, b)))) continue;
      if (!isLocallyNarrowest(point(a), point(b), surroundings)) continue;
      candidates.push_back({static_cast<int>(face), static_cast<int>(side), a, b, length,
                            std::max(corner(a).depth_cells, corner(b).depth_cells)});
    }
  }
  return candidates;
}

}  // namespace occusg
