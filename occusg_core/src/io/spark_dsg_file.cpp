// SPDX-License-Identifier: BSD-3-Clause
#include "io/spark_dsg_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <variant>

#include "io/graph_json.hpp"
#include "io/json_text.hpp"
#include "occusg/io/room_color.hpp"

namespace occusg {
namespace {

using nlohmann::json;

constexpr std::uint32_t kNoSemanticLabel = 0xFFFFFFFFU;
constexpr ColorTone kRoomTone{65.0, 45.0};

/// Where a node type lives in Spark-DSG.
struct Layer {
  int layer = 0;
  int partition = 0;
  char symbol = ' ';
};

std::optional<Layer> layerOf(NodeType type) {
  switch (type) {
    case NodeType::kAgent:
      return Layer{2, 'a', 'a'};
    case NodeType::kObject:
      return Layer{2, 0, 'O'};
    case NodeType::kNavigation:
      return Layer{3, 0, 'p'};
    case NodeType::kRoom:
      return Layer{4, 0, 'R'};
    default:
      return std::nullopt;
  }
}

/// Character in the top byte, number below.
std::uint64_t symbolOf(NodeId id) {
  const NodeType type = typeOfId(id).value_or(NodeType::kAgent);
  const auto layer = layerOf(type);
  const auto prefix = static_cast<unsigned char>(layer ? layer->symbol : ' ');
  return (static_cast<std::uint64_t>(prefix) << 56U) |
         static_cast<std::uint64_t>(numberOfId(type, id));
}

std::uint64_t nanoseconds(double stamp_s) {
  constexpr double kLargest_s = 9e9;
  const double clamped_s = std::clamp(rounded(stamp_s, 9), 0.0, kLargest_s);
  return static_cast<std::uint64_t>(std::llround(clamped_s * 1e9));
}

json rotation(const Eigen::Quaterniond& q) {
  return {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}};
}

json boxOf(const char* type, const Eigen::Vector3d& center, const Eigen::Vector3d& size) {
  return {{"type", type},
          {"dimensions", jsonOf(size)},
          {"world_P_center", jsonOf(center)},
          {"world_R_center", rotation(Eigen::Quaterniond::Identity())}};
}

json noBox() { return boxOf("INVALID", Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()); }

json boxAround(const Polygon& polygon, double z_m) {
  if (polygon.outer.empty()) return noBox();
  const Bounds2 box = bounds(polygon);
  const Point2 center = midpoint({box.min, box.max});
  return boxOf("AABB", {center.x, center.y, z_m},
               {box.max.x - box.min.x, box.max.y - box.min.y, 0.0});
}

json boxOf(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return noBox();
  return boxOf("AABB", box.center(), box.sizes());
}

json colorOf(const RgbColor& color) {
  return {{"r", color.r}, {"g", color.g}, {"b", color.b}, {"a", 255}};
}

json semantics(const std::string& name, const RgbColor& color, json box) {
  return {{"name", name},
          {"color", colorOf(color)},
          {"bounding_box", std::move(box)},
          {"semantic_label", kNoSemanticLabel},
          {"semantic_feature", {{"rows", 0}, {"cols", 0}, {"data", nullptr}}}};
}

json emptyLists(const std::vector<const char*>& keys) {
  json members = json::object();
  for (const char* key : keys) members[key] = json::array();
  return members;
}

/// The attributes Spark-DSG has for a node of the type, beyond those of every node.
class AttributeMembers {
 public:
  explicit AttributeMembers(const Node& node) : node_(node) {}

  json operator()(const AgentAttributes& agent) const {
    return {{"type", "AgentNodeAttributes"},
            {"timestamp", nanoseconds(node_.created_s)},
            {"world_R_body", rotation(canonicalRotation(agent.T_map_agent))},
            {"external_key", 0},
            {"dbow_ids", nullptr},
            {"dbow_values", nullptr}};
  }

  json operator()(const ObjectAttributes& object) const {
    json members = semantics(object.class_name, {}, boxOf(object.box));
    members.update(emptyLists({"mesh_connections"}));
    members["type"] = "ObjectNodeAttributes";
    members["registered"] = false;
    members["world_R_object"] = rotation(Eigen::Quaterniond::Identity());
    members["metadata"] = {{"score", rounded(object.score, 6)},
                           {"observations", object.observations}};
    return members;
  }

  json operator()(const NavigationAttributes& navigation) const {
    json members = semantics("", {}, noBox());
    members.update(emptyLists({"deformation_connections", "mesh_vertex_labels",
                               "pcl_mesh_connections", "voxblox_mesh_connections"}));
    members.update(json{{"type", "PlaceNodeAttributes"},
                        {"distance", 0.0},
                        {"num_basis_points", 0},
                        {"real_place", true},
                        {"active_frontier", false},
                        {"anti_frontier", false},
                        {"need_cleanup", false},
                        {"num_frontier_voxels", 0},
                        {"frontier_scale", json::array({0.0, 0.0, 0.0})},
                        {"orientation", rotation(Eigen::Quaterniond::Identity())}});
    members["metadata"] = {{"free_cells", navigation.free_cells}};
    return members;
  }

  json operator()(const RoomAttributes& room) const {
    json members = semantics(room.name, roomColor(roomNumber(node_.id), kRoomTone),
                             boxAround(room.polygon, node_.position.z()));
    members["type"] = "RoomNodeAttributes";
    members["semantic_class_probabilities"] = json::object();
    members["metadata"] = {{"polygon", jsonOf(room.polygon.outer)},
                           {"holes", holesOf(room.polygon)},
                           {"area_m2", rounded(room.area_m2)},
                           {"label", room.label},
                           {"label_score", rounded(room.label_score, 6)},
                           {"partial", room.state == RoomState::kPartial},
                           {"region_id", room.region_id}};
    return members;
  }

  /// Types that no layer of this format takes.
  template <typename Attributes>
  json operator()(const Attributes& /*attributes*/) const {
    return json::object();
  }

 private:
  const Node& node_;
};

void writePlaceAndTime(const Node& node, json& attributes) {
  attributes["position"] = jsonOf(node.position);
  attributes["last_update_time_ns"] = nanoseconds(node.last_seen_s);
}

json nodeOf(const Node& node, const Layer& layer) {
  json attributes = std::visit(AttributeMembers(node), node.attributes);
  attributes.emplace("metadata", json::object());
  writePlaceAndTime(node, attributes);
  attributes["is_active"] = false;
  attributes["is_predicted"] = false;
  return {{"id", symbolOf(node.id)},
          {"layer", layer.layer},
          {"partition", layer.partition},
          {"attributes", std::move(attributes)}};
}

json edgeOf(const Edge& edge) {
  json metadata = json::object();
  if (edge.type == EdgeType::kRoomAdjacency) metadata["crossings"] = crossingsOf(edge);
  // A parent is the end in the higher layer; Spark-DSG finds that out by itself.
  return {{"source", symbolOf(edge.source)},
          {"target", symbolOf(edge.target)},
          {"info",
           {{"type", "EdgeAttributes"},
            {"weighted", false},
            {"weight", 1.0},
            {"metadata", std::move(metadata)}}}};
}

/// Puts what tells one navigation node from another into `element`, which holds one already.
void overwrite(json& element, const Node& node) {
  element["id"] = symbolOf(node.id);
  json& attributes = element["attributes"];
  writePlaceAndTime(node, attributes);
  attributes["metadata"]["free_cells"] = std::get<NavigationAttributes>(node.attributes).free_cells;
}

/// The same for an edge without crossings.
void overwrite(json& element, const Edge& edge) {
  element["source"] = symbolOf(edge.source);
  element["target"] = symbolOf(edge.target);
}

// Most of a graph is navigation nodes and edges, each with dozens of members that never differ: one
// document serves for all of them instead of one being built for each.
void addNavigationNodes(const SceneGraph& graph, const Layer& layer, JsonStream& document) {
  json element;
  for (const auto& [id, node] : graph.nodes(NodeType::kNavigation)) {
    if (element.is_null()) element = nodeOf(node, layer);
    overwrite(element, node);
    document.element(element);
  }
}

void addNodes(const SceneGraph& graph, JsonStream& document) {
  document.beginList("nodes");
  for (std::size_t i = 0; i < kNodeTypeCount; ++i) {
    const auto type = static_cast<NodeType>(i);
    const auto layer = layerOf(type);
    if (!layer) continue;
    if (type == NodeType::kNavigation) {
      addNavigationNodes(graph, *layer, document);
      continue;
    }
    for (const auto& [id, node] : graph.nodes(type)) document.element(nodeOf(node, *layer));
  }
  document.endList();
}

void addEdges(const SceneGraph& graph, JsonStream& document) {
  document.beginList("edges");
  json plain;
  for (std::size_t i = 0; i < kEdgeTypeCount; ++i) {
    for (const auto& [ends, edge] : graph.edges(static_cast<EdgeType>(i))) {
      // A node has one parent there, and a room goes before a place.
      const bool has_room_parent =
          edge.type == EdgeType::kNearestFreeSpace && graph.roomOf(edge.source).has_value();
      if (has_room_parent) continue;
      if (edge.type == EdgeType::kRoomAdjacency) {
        document.element(edgeOf(edge));
        continue;
      }
      if (plain.is_null()) plain = edgeOf(edge);
      overwrite(plain, edge);
      document.element(plain);
    }
  }
  document.endList();
}

json keyOf(const Layer& layer) { return {{"layer", layer.layer}, {"partition", layer.partition}}; }

}  // namespace

void writeSparkDsg(const SceneGraph& graph, const std::string& scene, const std::string& frame,
                   std::ostream& out) {
  const Layer objects = *layerOf(NodeType::kObject);
  const Layer agents = *layerOf(NodeType::kAgent);
  const Layer places = *layerOf(NodeType::kNavigation);
  const Layer rooms = *layerOf(NodeType::kRoom);
  const Layer buildings{5, 0, 'B'};
  // Spark-DSG, not this program, reads it.
  JsonStream document(out, "scene graph", std::numeric_limits<std::size_t>::max());
  document.member("SPARK_DSG_header", {{"project_name", "main"},
                                       {"version", {{"major", 1}, {"minor", 1}, {"patch", 3}}}});
  document.member("directed", false);
  document.member("multigraph", false);
  document.member("metadata", {{"scene", scene}, {"frame", frame}});
  document.member("layer_keys", json::array({keyOf(objects), keyOf(agents), keyOf(places),
                                             keyOf(rooms), keyOf(buildings)}));
  document.member("layer_names", {{"OBJECTS", keyOf(objects)},
                                  {"AGENTS", keyOf(agents)},
                                  {"PLACES", keyOf(places)},
                                  {"ROOMS", keyOf(rooms)},
                                  {"BUILDINGS", keyOf(buildings)}});
  addNodes(graph, document);
  addEdges(graph, document);
  document.end();
}

std::string toSparkDsg(const SceneGraph& graph, const std::string& scene,
                       const std::string& frame) {
  std::ostringstream text;
  writeSparkDsg(graph, scene, frame, text);
  return text.str();
}

}  // namespace occusg
