// SPDX-License-Identifier: BSD-3-Clause
#include "graph/relinking.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "occusg/geometry/polygon_overlap.hpp"

namespace occusg {
namespace {

struct Proposal {
  Successor successor;
  double score = 0.0;
  double overlap = 0.0;
};

double shareInside(const std::vector<Point2>& points, const Polygon& polygon) {
  const auto inside = std::count_if(points.begin(), points.end(),
                                    [&](const Point2& point) { return contains(polygon, point); });
  return static_cast<double>(inside) / static_cast<double>(points.size());
}

std::optional<Proposal> proposal(const LostRoom& room, const Region& region,
                                 const RoomLayerConfig& config) {
  const double room_area_m2 = area(*room.footprint);
  const double common_m2 = intersectionArea(*room.footprint, region.polygon);
  const double overlap = common_m2 / room_area_m2;
  if (overlap < config.relink_min_overlap) return std::nullopt;
  const double members = room.members.empty() ? overlap : shareInside(room.members, region.polygon);
  const bool holds_centroid = contains(region.polygon, centroid(*room.footprint));
  const double min_members =
      holds_centroid ? config.relink_min_members : config.relink_min_members_off_centre;
  if (members < min_members) return std::nullopt;
  const double iou = common_m2 / (room_area_m2 + region.area_m2 - common_m2);
  const double score = 0.45 * overlap + 0.35 * members + 0.10 * iou + (holds_centroid ? 0.10 : 0.0);
  return Proposal{{room.id, region.id}, score, overlap};
}

/// Best first; equal ones by room, then by region.
bool isBetter(const Proposal& a, const Proposal& b) {
  return std::make_tuple(-a.score, -a.overlap, a.successor.room, a.successor.region) <
         std::make_tuple(-b.score, -b.overlap, b.successor.room, b.successor.region);
}

std::optional<Proposal> unambiguousProposal(const LostRoom& room,
                                            const std::vector<const Region*>& unowned,
                                            const RoomLayerConfig& config) {
  std::vector<Proposal> proposals;
  for (const Region* region : unowned)
    if (const auto made = proposal(room, *region, config)) proposals.push_back(*made);
  if (proposals.empty()) return std::nullopt;
  std::sort(proposals.begin(), proposals.end(), isBetter);
  if (proposals.size() > 1 && proposals[0].score - proposals[1].score < config.relink_min_margin)
    return std::nullopt;
  return proposals.front();
}

}  // namespace

std::vector<Successor> successorsOf(const std::vector<LostRoom>& rooms,
                                    const std::vector<const Region*>& unowned,
                                    const RoomLayerConfig& config) {
  std::vector<Proposal> proposals;
  for (const LostRoom& room : rooms)
    if (const auto made = unambiguousProposal(room, unowned, config)) proposals.push_back(*made);
  std::sort(proposals.begin(), proposals.end(), isBetter);
  std::vector<Successor> successors;
  std::set<int> taken;
  for (const Proposal& made : proposals)
    if (taken.insert(made.successor.region).second) successors.push_back(made.successor);
  return successors;
}

}  // namespace occusg
