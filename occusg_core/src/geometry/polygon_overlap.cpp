// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/geometry/polygon_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <polyclipping/clipper.hpp>
#include <string>
#include <utility>

#include "edge_contacts.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

constexpr double kUnitsPerMetre = 1e7;

/// How often a piece is shaved free, by twice as much each time, before it is given up as a sliver.
constexpr int kMaxShavings = 8;

/// Contacts of edges up to which polygons are taken whatever their number of edges, and beyond that
/// for each edge. Outlines that follow the same cells touch four times at each of their vertices,
/// triangles of a mesh some thirty times.
constexpr std::size_t kFreeContacts = 100'000;
constexpr std::size_t kContactsPerEdge = 64;

/// A ring that crosses itself falls apart into about as many pieces as it has crossings, and each
/// is tested by itself.
constexpr std::size_t kFreeOwnContacts = 5'000;
constexpr std::size_t kOwnContactsPerEdge = 8;

std::size_t edgeCount(const Paths& paths) {
  std::size_t sum = 0;
  for (const Path& path : paths) sum += path.size();
  return sum;
}

void refuseMoreContactsThan(std::size_t limit, const Paths& paths, const std::string& what) {
  if (!hasMoreContactsThan(limit, paths)) return;
  throw refuse(what, "edges cross or touch at more than " + std::to_string(limit) + " places",
               "outlines of rooms that do not cross themselves are needed");
}

void refuseTangles(const Paths& paths) {
  refuseMoreContactsThan(std::max(kFreeOwnContacts, kOwnContactsPerEdge * edgeCount(paths)), paths,
                         "polygon of " + std::to_string(edgeCount(paths)) + " vertices");
}

void refuseTangles(Paths subject, const Paths& clip) {
  subject.insert(subject.end(), clip.begin(), clip.end());
  refuseMoreContactsThan(
      std::max(kFreeContacts, kContactsPerEdge * edgeCount(subject)), subject,
      "polygons of together " + std::to_string(edgeCount(subject)) + " vertices");
}

void checkCoordinates(const Ring& ring, const std::string& where) {
  for (const Point2& point : ring) {
    for (const double value : {point.x, point.y}) {
      if (std::abs(value) <= kMaxCoordinate_m) continue;  // false for NaN, too
      throw refuse(
          where, "coordinate " + std::to_string(value),
          "must be finite and at most " + std::to_string(kMaxCoordinate_m) + " m from the origin");
    }
  }
}

IntPoint toLattice(const Point2& point) {
  return {static_cast<ClipperLib::cInt>(std::llround(point.x * kUnitsPerMetre)),
          static_cast<ClipperLib::cInt>(std::llround(point.y * kUnitsPerMetre))};
}

Path toLattice(const Ring& ring) {
  Path path;
  path.reserve(ring.size());
  for (const Point2& point : ring) path.push_back(toLattice(point));
  return path;
}

/// Signed area [m2], summed about the first vertex so that nothing is lost far from the origin.
double signedArea(const Path& path) {
  double twice = 0.0;
  for (std::size_t i = 2; i < path.size(); ++i) {
    const auto ax = static_cast<double>(path[i - 1].X - path[0].X);
    const auto ay = static_cast<double>(path[i - 1].Y - path[0].Y);
    const auto bx = static_cast<double>(path[i].X - path[0].X);
    const auto by = static_cast<double>(path[i].Y - path[0].Y);
    twice += ax * by - ay * bx;
  }
  return twice / 2.0 / (kUnitsPerMetre * kUnitsPerMetre);
}

enum class Turn { kCounterClockwise, kClockwise };

Path oriented(Path path, Turn turn) {
  if ((signedArea(path) < 0.0) != (turn == Turn::kClockwise)) ClipperLib::ReversePath(path);
  return path;
}

/// Outer ring counter-clockwise, holes clockwise, for the non-zero rule.
void addTo(Paths& paths, const Polygon& polygon) {
  paths.push_back(oriented(toLattice(polygon.outer), Turn::kCounterClockwise));
  for (const Ring& hole : polygon.holes)
    paths.push_back(oriented(toLattice(hole), Turn::kClockwise));
}

Paths toLattice(const Polygon& polygon) {
  Paths paths;
  addTo(paths, polygon);
  return paths;
}

double commonArea(const Paths& subject, const Paths& clip) {
  refuseTangles(subject, clip);
  ClipperLib::Clipper clipper;
  clipper.AddPaths(subject, ClipperLib::ptSubject, true);
  clipper.AddPaths(clip, ClipperLib::ptClip, true);
  Paths common;
  clipper.Execute(ClipperLib::ctIntersection, common, ClipperLib::pftEvenOdd,
                  ClipperLib::pftNonZero);
  double sum = 0.0;
  for (const Path& path : common) sum += signedArea(path);
  return std::max(0.0, sum);
}

bool boundsOverlap(const Polygon& a, const Polygon& b) {
  if (a.outer.empty() || b.outer.empty()) return false;
  const Bounds2 box_a = bounds(a);
  const Bounds2 box_b = bounds(b);
  return box_a.min.x < box_b.max.x && box_b.min.x < box_a.max.x && box_a.min.y < box_b.max.y &&
         box_b.min.y < box_a.max.y;
}

Ring toRing(const Path& path) {
  Ring ring;
  ring.reserve(path.size());
  for (const IntPoint& point : path) {
    ring.push_back({static_cast<double>(point.X) / kUnitsPerMetre,
                    static_cast<double>(point.Y) / kUnitsPerMetre});
  }
  return ring;
}

/// Appends the outer ring `node` with its holes, and the islands in those.
void appendPolygons(const ClipperLib::PolyNode& node, std::vector<Polygon>& polygons) {
  Polygon polygon{toRing(node.Contour), {}};
  for (const ClipperLib::PolyNode* hole : node.Childs) {
    polygon.holes.push_back(toRing(hole->Contour));
    for (const ClipperLib::PolyNode* island : hole->Childs) appendPolygons(*island, polygons);
  }
  polygons.push_back(std::move(polygon));
}

std::vector<Polygon> evenOddUnion(const Paths& paths) {
  ClipperLib::Clipper clipper;
  clipper.StrictlySimple(true);
  clipper.AddPaths(paths, ClipperLib::ptSubject, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
  std::vector<Polygon> polygons;
  for (const ClipperLib::PolyNode* node : tree.Childs) appendPolygons(*node, polygons);
  return polygons;
}

/// Takes `units` off all round, which frees rings that touch.
Paths shaved(const Paths& paths, double units) {
  ClipperLib::ClipperOffset offset;
  offset.AddPaths(paths, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
  Paths smaller;
  offset.Execute(smaller, -units);
  return smaller;
}

/// Larger first, ties by where the outer ring starts.
bool comesFirst(const Polygon& a, const Polygon& b) {
  const double area_a = area(a);
  const double area_b = area(b);
  if (area_a != area_b) return area_a > area_b;
  const Point2& p = a.outer.front();
  const Point2& q = b.outer.front();
  return p.x != q.x ? p.x < q.x : p.y < q.y;
}

/// The pieces `rest` encloses under the even-odd rule, each simple; largest first.
std::vector<Polygon> disentangled(Paths rest) {
  std::vector<Polygon> pieces;
  double shaving = 1.0;
  for (int round = 0; round <= kMaxShavings && !rest.empty(); ++round) {
    Paths entangled;
    for (Polygon& piece : evenOddUnion(rest)) {
      if (isSimple(piece)) {
        pieces.push_back(std::move(piece));
      } else {
        addTo(entangled, piece);
      }
    }
    // Clipper leaves rings that touch themselves or each other in the middle of an edge.
    shaving *= 2.0;
    rest = shaved(entangled, shaving);
  }
  std::sort(pieces.begin(), pieces.end(), comesFirst);
  return pieces;
}

std::vector<Polygon> combined(const Paths& subject, const Paths& clip, ClipperLib::ClipType how) {
  refuseTangles(subject, clip);
  ClipperLib::Clipper clipper;
  clipper.AddPaths(subject, ClipperLib::ptSubject, true);
  clipper.AddPaths(clip, ClipperLib::ptClip, true);
  Paths result;
  clipper.Execute(how, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return disentangled(std::move(result));
}

}  // namespace

void checkCoordinates(const Polygon& polygon, const std::string& where) {
  checkCoordinates(polygon.outer, where);
  for (const Ring& hole : polygon.holes) checkCoordinates(hole, where);
}

double intersectionArea(const Polygon& a, const Polygon& b) {
  checkCoordinates(a, "polygon");
  checkCoordinates(b, "polygon");
  return boundsOverlap(a, b) ? commonArea(toLattice(a), toLattice(b)) : 0.0;
}

double intersectionOverUnion(const Polygon& a, const Polygon& b) {
  const double common = intersectionArea(a, b);
  const double either = area(a) + area(b) - common;
  return either > 0.0 ? std::clamp(common / either, 0.0, 1.0) : 0.0;
}

double coveredArea(const Polygon& polygon, const std::vector<Polygon>& others) {
  checkCoordinates(polygon, "polygon");
  Paths cover;
  for (const Polygon& other : others) {
    checkCoordinates(other, "polygon");
    if (boundsOverlap(polygon, other)) addTo(cover, other);
  }
  return cover.empty() ? 0.0 : commonArea(toLattice(polygon), cover);
}

std::vector<Polygon> repaired(const Polygon& polygon) {
  checkCoordinates(polygon, "polygon");
  const Paths paths = toLattice(polygon);
  refuseTangles(paths);
  return disentangled(paths);
}

std::vector<Polygon> united(const std::vector<Polygon>& polygons) {
  Paths paths;
  for (const Polygon& polygon : polygons) {
    checkCoordinates(polygon, "polygon");
    if (!polygon.outer.empty()) addTo(paths, polygon);
  }
  return combined(paths, {}, ClipperLib::ctUnion);
}

std::vector<Polygon> difference(const Polygon& polygon, const std::vector<Polygon>& others) {
  checkCoordinates(polygon, "polygon");
  Paths cover;
  for (const Polygon& other : others) {
    checkCoordinates(other, "polygon");
    if (boundsOverlap(polygon, other)) addTo(cover, other);
  }
  return combined(toLattice(polygon), cover, ClipperLib::ctDifference);
}

}  // namespace occusg
