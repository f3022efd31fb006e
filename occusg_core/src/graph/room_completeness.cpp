// SPDX-License-Identifier: BSD-3-Clause
#include "graph/room_completeness.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace occusg {
namespace {

// A wall may begin a cell or two beyond the free space: its face is where rays end.
constexpr int kWallWithin_cells = 3;
// A share that moves by less is not worth telling.
constexpr double kShareStep = 0.01;
// Rooms are no larger; what is found near a change by its node must be within reach.
constexpr double kReach_m = 15.0;
constexpr std::int64_t kMostSamples = 100'000;

struct Tally {
  std::int64_t samples = 0;
  std::int64_t frontier = 0;
};

bool isFrontier(const FreeSpace& layer, const Point2& edge_point, const Point2& outward) {
  for (int step = 0; step < kWallWithin_cells; ++step) {
    const double reach_m = (step + 0.5) * layer.frame.resolution_m;
    const Point2 at{edge_point.x + reach_m * outward.x, edge_point.y + reach_m * outward.y};
    if (layer.cells.valueOr(layer.frame.cellAt(at), kUnknown) != kUnknown) return false;
  }
  return true;
}

/// Rings run with the area on their left: the outside is on the right.
void addRing(const Ring& ring, const FreeSpace& layer, double spacing_m, Tally& tally) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Segment2 edge{ring[i], ring[(i + 1) % ring.size()]};
    const double length_m = length(edge);
    if (!(length_m > 0.0)) continue;
    const Point2 along{(edge.b.x - edge.a.x) / length_m, (edge.b.y - edge.a.y) / length_m};
    const auto samples = static_cast<std::int64_t>(std::ceil(length_m / spacing_m));
    for (std::int64_t sample = 0; sample < samples; ++sample) {
      const double at_m =
          (static_cast<double>(sample) + 0.5) * length_m / static_cast<double>(samples);
      const Point2 point{edge.a.x + at_m * along.x, edge.a.y + at_m * along.y};
      ++tally.samples;
      if (isFrontier(layer, point, {along.y, -along.x})) ++tally.frontier;
    }
  }
}

/// Whether what is just outside of the polygon may lie in the box.
bool isTouchedBy(const Bounds2& box, const Polygon& polygon, double resolution_m) {
  if (polygon.outer.empty()) return false;
  const Bounds2 own = bounds(polygon);
  const double margin_m = kWallWithin_cells * resolution_m;
  return own.min.x - margin_m <= box.max.x && box.min.x <= own.max.x + margin_m &&
         own.min.y - margin_m <= box.max.y && box.min.y <= own.max.y + margin_m;
}

}  // namespace

double frontierShare(const Polygon& polygon, const FreeSpace& layer) {
  const double spacing_m =
      std::max(layer.frame.resolution_m, perimeter(polygon) / static_cast<double>(kMostSamples));
  Tally tally;
  addRing(polygon.outer, layer, spacing_m, tally);
  for (const Ring& hole : polygon.holes) addRing(hole, layer, spacing_m, tally);
  if (tally.samples == 0) return 0.0;
  return static_cast<double>(tally.frontier) / static_cast<double>(tally.samples);
}

RoomCompleteness::RoomCompleteness(double max_frontier_share)
    : max_frontier_share_(max_frontier_share) {}

void RoomCompleteness::restore(const SceneGraph& graph) {
  *this = RoomCompleteness(max_frontier_share_);
  for (const auto& [id, node] : graph.nodes(NodeType::kRoom))
    if (graph.room(id).state == RoomState::kConfirmed) confirmed_.insert(id);
}

void RoomCompleteness::update(SceneGraph& graph, const FreeSpace& layer, const CellBox& changed) {
  const GraphChanges changes = graph.changesSince(revision_);
  std::set<NodeId> rooms;
  for (const auto* list : {&changes.added_nodes, &changes.changed_nodes}) {
    for (const NodeId id : *list)
      if (isRoomId(id)) rooms.insert(id);
  }
  for (const NodeId id : changes.removed_nodes) confirmed_.erase(id);
  if (!changes.complete)
    for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) rooms.insert(id);
  if (!changed.empty()) {
    const Point2 low = layer.frame.corner(changed.min);
    const Point2 high = layer.frame.corner(changed.max);
    const Bounds2 reach{{low.x - kReach_m, low.y - kReach_m},
                        {high.x + kReach_m, high.y + kReach_m}};
    for (const NodeId id : graph.inBox(NodeType::kRoom, reach)) {
      if (isTouchedBy({low, high}, graph.room(id).polygon, layer.frame.resolution_m))
        rooms.insert(id);
    }
  }
  for (const NodeId room : rooms) judge(graph, room, layer);
  revision_ = graph.revision();
}

void RoomCompleteness::judge(SceneGraph& graph, NodeId room, const FreeSpace& layer) {
  const RoomAttributes& known = graph.room(room);
  const double share = frontierShare(known.polygon, layer);
  if (share <= max_frontier_share_) confirmed_.insert(room);
  const RoomState state = confirmed_.count(room) > 0 ? RoomState::kConfirmed : RoomState::kPartial;
  if (known.state == state && std::abs(known.frontier_share - share) < kShareStep) return;
  Node node = graph.at(room);
  auto& attributes = std::get<RoomAttributes>(node.attributes);
  attributes.state = state;
  attributes.frontier_share = share;
  graph.update(std::move(node));
}

}  // namespace occusg
