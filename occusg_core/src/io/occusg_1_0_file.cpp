// SPDX-License-Identifier: BSD-3-Clause
#include "io/occusg_1_0_file.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "io/graph_json.hpp"
#include "io/json_text.hpp"

namespace occusg {
namespace {

using nlohmann::json;

json pointMembers(const Point2& point) {
  return {{"x", rounded(point.x)}, {"y", rounded(point.y)}};
}

json ringMembers(const Ring& ring) {
  json points = json::array();
  for (const Point2& point : ring) points.push_back(pointMembers(point));
  return points;
}

json boundsMembers(const Polygon& polygon) {
  const Bounds2 box = bounds(polygon);
  return {{"min_x", rounded(box.min.x)},
          {"max_x", rounded(box.max.x)},
          {"min_y", rounded(box.min.y)},
          {"max_y", rounded(box.max.y)}};
}

const char* layerOf(NodeType type) {
  switch (type) {
    case NodeType::kAgent:
      return "MOTION";
    case NodeType::kObject:
      return "OBJECT";
    case NodeType::kNavigation:
      return "NAVIGATION";
    default:
      return "SEMANTIC";
  }
}

json orientationOf(const Node& node) {
  const auto* agent = std::get_if<AgentAttributes>(&node.attributes);
  const Eigen::Quaterniond q =
      agent == nullptr ? Eigen::Quaterniond::Identity() : canonicalRotation(agent->T_map_agent);
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

/// The attributes of a node, and the parts that are repeated under other names.
struct Described {
  json attributes = json::object();
  json geometry = json::object();
  json semantic = json::object();
};

struct Describe {
  /// Types the published system gives no attributes.
  template <typename Attributes>
  Described operator()(const Attributes& /*attributes*/) const {
    return {};
  }
  Described operator()(const ObjectAttributes& object) const {
    Described described;
    described.semantic = {{"class_name", object.class_name},
                          {"detection_score", rounded(object.score, kScoreDigits)}};
    described.attributes = described.semantic;
    return described;
  }
  Described operator()(const NavigationAttributes& navigation) const {
    Described described;
    described.attributes = {{"grid_block", {{"x", navigation.block.x}, {"y", navigation.block.y}}},
                            {"free_cell_count", navigation.free_cells}};
    return described;
  }
  Described operator()(const RoomAttributes& room) const {
    Described described;
    json holes = json::array();
    for (const Ring& hole : room.polygon.holes) holes.push_back(ringMembers(hole));
    described.geometry = {{"polygon", ringMembers(room.polygon.outer)},
                          {"holes", std::move(holes)},
                          {"convex_hull", ringMembers(convexHull(room.polygon.outer))}};
    if (!room.polygon.outer.empty()) {
      described.geometry["centroid"] = pointMembers(centroid(room.polygon));
      described.geometry["bounds"] = boundsMembers(room.polygon);
    }
    described.attributes = described.geometry;
    described.attributes.update(json{{"name", room.name},
                                     {"label", room.label},
                                     {"tracker_region_id", room.region_id},
                                     {"stable_region_id", room.region_id},
                                     {"is_bootstrap_region", room.isBootstrap()},
                                     {"created_reason", nameOf(room.reason)}});
    return described;
  }
};

json membersOf(const Node& node) {
  Described described = std::visit(Describe{}, node.attributes);
  return {{"id", node.id},
          {"type", nameOf(node.type())},
          {"layer", layerOf(node.type())},
          {"pose",
           {{"position",
             {{"x", rounded(node.position.x())},
              {"y", rounded(node.position.y())},
              {"z", rounded(node.position.z())}}},
            {"orientation", orientationOf(node)}}},
          {"created_at", rounded(node.created_s, kStampDigits)},
          {"last_seen", rounded(node.last_seen_s, kStampDigits)},
          {"active", true},
          {"attributes", std::move(described.attributes)},
          {"geometry", std::move(described.geometry)},
          {"semantic", std::move(described.semantic)}};
}

bool isStructural(EdgeType type) {
  return type == EdgeType::kTemporal || type == EdgeType::kContains;
}

/// Directed: what has no direction is there twice. Ordered by source, target, type.
std::vector<std::tuple<NodeId, NodeId, EdgeType>> directedEdges(const SceneGraph& graph) {
  std::vector<std::tuple<NodeId, NodeId, EdgeType>> edges;
  for (std::size_t i = 0; i < kEdgeTypeCount; ++i) {
    const auto type = static_cast<EdgeType>(i);
    for (const auto& [ends, edge] : graph.edges(type)) {
      edges.emplace_back(edge.source, edge.target, type);
      if (!isDirected(type)) edges.emplace_back(edge.target, edge.source, type);
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

json edgesOf(const SceneGraph& graph, std::map<std::string, int>& counts) {
  json edges = json::array();
  for (const auto& [source, target, type] : directedEdges(graph)) {
    ++counts[nameOf(type)];
    edges.push_back({{"id", edges.size()},
                     {"source", source},
                     {"target", target},
                     {"type", nameOf(type)},
                     {"weight", 1.0},
                     {"is_structural", isStructural(type)},
                     {"attributes", json::object()}});
  }
  return edges;
}

json nodesOf(const SceneGraph& graph, std::map<std::string, int>& counts) {
  json nodes = json::array();
  for (const NodeType type :
       {NodeType::kAgent, NodeType::kObject, NodeType::kNavigation, NodeType::kRoom}) {
    for (const auto& [id, node] : graph.nodes(type)) {
      ++counts[nameOf(type)];
      nodes.push_back(membersOf(node));
    }
  }
  return nodes;
}

}  // namespace

std::string toOccusg10(const SceneGraph& graph, const std::string& scene,
                       const std::string& frame) {
  std::map<std::string, int> node_counts;
  std::map<std::string, int> edge_counts;
  json nodes = nodesOf(graph, node_counts);
  json edges = edgesOf(graph, edge_counts);
  const json metadata = {{"graph_name", scene},
                         {"frame_id", frame},
                         {"stamp", nullptr},
                         {"export_time_unix", nullptr},
                         {"num_nodes", nodes.size()},
                         {"num_edges", edges.size()},
                         {"node_type_counts", node_counts},
                         {"edge_type_counts", edge_counts}};
  return jsonDocument({{"schema_version", "1.0"},
                       {"metadata", metadata},
                       {"nodes", std::move(nodes)},
                       {"edges", std::move(edges)}});
}

}  // namespace occusg
