// SPDX-License-Identifier: BSD-3-Clause
#include "io/graphml_file.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <string>
#include <variant>

#include "io/graph_json.hpp"
#include "io/json_text.hpp"

namespace occusg {
namespace {

constexpr int kDigits = 4;
constexpr int kFineDigits = 6;

constexpr const char* kKeys =
    R"( <key id="scene" for="graph" attr.name="scene" attr.type="string"/>
 <key id="type" for="node" attr.name="type" attr.type="string"/>
 <key id="x" for="node" attr.name="x" attr.type="double"/>
 <key id="y" for="node" attr.name="y" attr.type="double"/>
 <key id="z" for="node" attr.name="z" attr.type="double"/>
 <key id="floor" for="node" attr.name="floor_id" attr.type="int"/>
 <key id="name" for="node" attr.name="name" attr.type="string"/>
 <key id="label" for="node" attr.name="label" attr.type="string"/>
 <key id="area" for="node" attr.name="area_m2" attr.type="double"/>
 <key id="width" for="node" attr.name="width_m" attr.type="double"/>
 <key id="created" for="node" attr.name="created_s" attr.type="double"/>
 <key id="seen" for="node" attr.name="last_seen_s" attr.type="double"/>
 <key id="score" for="node" attr.name="score" attr.type="double"/>
 <key id="observations" for="node" attr.name="observations" attr.type="int"/>
 <key id="histogram" for="node" attr.name="class_histogram" attr.type="string"/>
 <key id="box" for="node" attr.name="box" attr.type="string"/>
 <key id="state" for="node" attr.name="state" attr.type="string"/>
 <key id="frontier" for="node" attr.name="frontier_share" attr.type="double"/>
 <key id="label_score" for="node" attr.name="label_score" attr.type="double"/>
 <key id="label_source" for="node" attr.name="label_source" attr.type="string"/>
 <key id="region" for="node" attr.name="region_id" attr.type="int"/>
 <key id="free" for="node" attr.name="free_cells" attr.type="int"/>
 <key id="room_a" for="node" attr.name="room_a" attr.type="string"/>
 <key id="room_b" for="node" attr.name="room_b" attr.type="string"/>
 <key id="edge" for="edge" attr.name="type" attr.type="string"/>
)";

/// Text as XML holds it; characters that XML 1.0 cannot hold become "?".
std::string escaped(const std::string& text) {
  std::string result;
  // The JSON library's way with bytes that are not UTF-8.
  const std::string utf8 =
      nlohmann::json::parse(
          nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
          .get<std::string>();
  for (const char c : utf8) {
    const bool is_control = static_cast<unsigned char>(c) < 0x20U && c != '\t' && c != '\n';
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += is_control ? '?' : c;
    }
  }
  return result;
}

std::string data(const char* key, const std::string& value) {
  return std::string("<data key=\"") + key + "\">" + value + "</data>";
}

std::string data(const char* key, double value, int digits = kDigits) {
  return data(key, toText(rounded(value, digits)));
}

std::string textOf(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// What a node has by its type.
struct AttributeData {
  /// Types without attributes of their own in this format.
  template <typename Attributes>
  std::string operator()(const Attributes& /*attributes*/) const {
    return "";
  }
  std::string operator()(const ObjectAttributes& object) const {
    std::string text = data("label", escaped(object.class_name)) +
                       data("score", object.score, kFineDigits) +
                       data("observations", std::to_string(object.observations)) +
                       data("histogram", escaped(textOf(histogramOf(object))));
    if (!object.box.isEmpty()) text += data("box", textOf(cornersOf(object.box)));
    return text;
  }
  std::string operator()(const NavigationAttributes& navigation) const {
    return data("free", std::to_string(navigation.free_cells));
  }
  std::string operator()(const RoomAttributes& room) const {
    return data("name", escaped(room.name)) + data("label", escaped(room.label)) +
           data("area", room.area_m2) + data("state", nameOf(room.state)) +
           data("frontier", room.frontier_share, kFineDigits) +
           data("label_score", room.label_score, kFineDigits) +
           data("label_source", nameOf(room.label_source)) +
           data("region", std::to_string(room.region_id));
  }
  std::string operator()(const DoorAttributes& door) const {
    return data("width", door.width_m) + data("room_a", "n" + std::to_string(door.room_a)) +
           data("room_b", "n" + std::to_string(door.room_b));
  }
  std::string operator()(const StairsAttributes& stairs) const {
    return data("room_a", "n" + std::to_string(stairs.lower_room)) +
           data("room_b", "n" + std::to_string(stairs.upper_room));
  }
};

std::string elementOf(const Node& node) {
  return "  <node id=\"n" + std::to_string(node.id) + "\">" + data("type", nameOf(node.type())) +
         data("x", node.position.x()) + data("y", node.position.y()) +
         data("z", node.position.z()) + data("floor", std::to_string(node.floor_id)) +
         data("created", node.created_s, kFineDigits) +
         data("seen", node.last_seen_s, kFineDigits) +
         std::visit(AttributeData{}, node.attributes) + "</node>\n";
}

std::string elementOf(const Edge& edge) {
  return "  <edge source=\"n" + std::to_string(edge.source) + "\" target=\"n" +
         std::to_string(edge.target) + "\">" + data("edge", nameOf(edge.type)) + "</edge>\n";
}

}  // namespace

void writeGraphMl(const SceneGraph& graph, const std::string& scene, std::ostream& out) {
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n"
      << kKeys << " <graph edgedefault=\"directed\">\n  " << data("scene", escaped(scene)) << "\n";
  for (std::size_t type = 0; type < kNodeTypeCount; ++type) {
    for (const auto& [id, node] : graph.nodes(static_cast<NodeType>(type))) out << elementOf(node);
  }
  for (std::size_t type = 0; type < kEdgeTypeCount; ++type) {
    for (const auto& [ends, edge] : graph.edges(static_cast<EdgeType>(type)))
      out << elementOf(edge);
  }
  out << " </graph>\n</graphml>\n";
}

std::string toGraphMl(const SceneGraph& graph, const std::string& scene) {
  std::ostringstream text;
  writeGraphMl(graph, scene, text);
  return text.str();
}

}  // namespace occusg
