// SPDX-License-Identifier: BSD-3-Clause
#include "graph/room_labels.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "graph/class_key.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr double kLeastEvidence = 0.5;
constexpr double kLargestSecond = 2.0 / 3.0;
constexpr int kMostOfClass = 2;

bool isObject(NodeId id) {
  return id >= firstId(NodeType::kObject) && id < firstId(NodeType::kNavigation);
}

}  // namespace

RoomLabelTable defaultRoomLabels() {
  return {
      {"bathroom",
       {{"bathtub", 1.0},
        {"hair_drier", 0.5},
        {"shower", 1.0},
        {"sink", 0.3},
        {"toilet", 1.0},
        {"toothbrush", 0.5},
        {"washing_basin", 0.7}}},
      {"bedroom", {{"bed", 1.5}, {"nightstand", 0.7}, {"single_bed", 1.5}, {"wardrobe", 0.7}}},
      {"classroom", {{"blackboard", 1.0}, {"pupil_desk", 1.0}}},
      {"conference_room", {{"conference_table", 1.5}, {"projector", 0.5}, {"whiteboard", 0.5}}},
      {"dining_room", {{"dining_table", 0.8}, {"wine_glass", 0.3}}},
      {"entrance", {{"shoe_cabinet", 1.0}, {"shoe_rack", 0.7}, {"umbrella", 0.3}}},
      {"kitchen",
       {{"cooking_counter", 1.0},
        {"fridge", 1.0},
        {"kitchen_cabinet", 0.8},
        {"microwave", 0.8},
        {"oven", 1.0},
        {"range_hood", 1.0},
        {"refrigerator", 1.0},
        {"sink", 0.3},
        {"stove", 1.0},
        {"toaster", 0.8}}},
      {"living_room",
       {{"couch", 1.0},
        {"remote", 0.2},
        {"sofa", 1.0},
        {"television", 0.5},
        {"tv", 0.5},
        {"tv_cabinet", 0.7},
        {"tv_stand", 0.7}}},
      {"office",
       {{"computer", 0.5},
        {"desk", 0.6},
        {"keyboard", 0.4},
        {"laptop", 0.4},
        {"monitor", 0.5},
        {"mouse", 0.3},
        {"office_chair", 0.7},
        {"office_desk", 1.0},
        {"whiteboard", 0.3}}},
      {"washing_room", {{"dryer", 1.0}, {"washing_basin", 0.3}, {"washing_machine", 1.5}}},
  };
}

RoomLabel labelFor(const std::vector<std::string>& object_classes, const RoomLabelTable& table) {
  std::map<std::string, int> count;
  for (const std::string& name : object_classes) ++count[classKey(name)];
  RoomLabel best;
  double best_sum = 0.0;
  double second_sum = 0.0;
  double total = 0.0;
  for (const auto& [label, weights] : table) {
    double sum = 0.0;
    for (const auto& [name, weight] : weights) {
      const auto found = count.find(name);
      if (found != count.end()) sum += weight * std::min(found->second, kMostOfClass);
    }
    total += sum;
    if (sum > best_sum) {
      second_sum = best_sum;
      best_sum = sum;
      best.label = label;
    } else {
      second_sum = std::max(second_sum, sum);
    }
  }
  if (best_sum < kLeastEvidence || second_sum > kLargestSecond * best_sum) return {};
  best.score = best_sum / (total + kLeastEvidence);
  return best;
}

RoomLabeler::RoomLabeler(RoomLabelTable table) : table_(std::move(table)) {}

void RoomLabeler::update(SceneGraph& graph) {
  const GraphChanges changes = graph.changesSince(revision_);
  std::set<NodeId> rooms;
  if (changes.complete) {
    for (const auto* list : {&changes.added_edges, &changes.removed_edges}) {
      for (const EdgeKey& edge : *list)
        if (edge.type == EdgeType::kContains && isObject(edge.target)) rooms.insert(edge.source);
    }
    for (const NodeId id : changes.changed_nodes) {
      const auto room = isObject(id) ? graph.roomOf(id) : std::nullopt;
      if (room) rooms.insert(*room);
      if (isRoomId(id)) rooms.insert(id);  // a person may have taken a label back
    }
  } else {
    for (const auto& [id, node] : graph.nodes(NodeType::kRoom)) rooms.insert(id);
  }
  for (const NodeId room : rooms) label(graph, room);
  revision_ = graph.revision();
}

void RoomLabeler::label(SceneGraph& graph, NodeId room) const {
  const Node* const node = graph.find(room);
  if (node == nullptr || graph.room(room).label_source == LabelSource::kPerson) return;
  std::vector<std::string> classes;
  for (const NodeId member : graph.targets(EdgeType::kContains, room)) {
    if (isObject(member))
      classes.push_back(std::get<ObjectAttributes>(graph.at(member).attributes).class_name);
  }
  const RoomLabel wanted = labelFor(classes, table_);
  const RoomAttributes& known = graph.room(room);
  if (known.label == wanted.label && known.label_score == wanted.score) return;
  Node changed = *node;
  auto& attributes = std::get<RoomAttributes>(changed.attributes);
  attributes.label = wanted.label;
  attributes.label_score = wanted.score;
  graph.update(std::move(changed));
}

void setLabelByPerson(SceneGraph& graph, NodeId room, const std::string& label) {
  (void)graph.room(room);
  const bool has_control = std::any_of(label.begin(), label.end(), [](char character) {
    return static_cast<unsigned char>(character) < 0x20U || character == 0x7F;
  });
  if (has_control || label.size() > kMaxLabelLength) {
    throw refuse("label of room " + std::to_string(room),
                 has_control ? "it holds a control character"
                             : "it has " + std::to_string(label.size()) + " bytes",
                 "one line of at most " + std::to_string(kMaxLabelLength) + " bytes is needed");
  }
  Node node = graph.at(room);
  auto& attributes = std::get<RoomAttributes>(node.attributes);
  const bool is_given = !label.empty();
  attributes.label = is_given ? label : kUnknownLabel;
  attributes.label_score = is_given ? 1.0 : 0.0;
  attributes.label_source = is_given ? LabelSource::kPerson : LabelSource::kAutomatic;
  graph.update(std::move(node));
}

}  // namespace occusg
