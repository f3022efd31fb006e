// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/object_layer.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "occusg/graph/class_key.hpp"
#include "occusg/graph/ghost_check.hpp"

namespace occusg {
namespace {

// Boxes of surfaces seen from one side are flat: without a margin flat boxes have nothing in
// common.
constexpr double kBoxMargin_m = 0.05;
// Objects of different classes so alike in place and size are one object the detector is unsure of.
constexpr double kSameThing = 0.5;
constexpr std::size_t kGhostChecksPerCall = 32;
// A kilometre-sized box is no object and would be listed everywhere.
constexpr double kLargestObject_m = 50.0;

const ObjectAttributes& objectIn(const Node& node) {
  return std::get<ObjectAttributes>(node.attributes);
}

bool isUsable(const Detection& detection) {
  const Eigen::AlignedBox3d& box = detection.box;
  return detection.centroid.allFinite() && box.min().allFinite() && box.max().allFinite() &&
         !box.isEmpty() && box.sizes().maxCoeff() <= kLargestObject_m && detection.score >= 0.0 &&
         detection.score <= 1.0;
}

/// Indices of the usable detections, the best if there are too many, in their order.
std::vector<std::size_t> usable(const std::vector<Detection>& detections, ObjectCounts& counts) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (isUsable(detections[i])) {
      indices.push_back(i);
    } else {
      ++counts.refused;
    }
  }
  if (indices.size() > kMaxDetectionsPerFrame) {
    counts.over_limit += indices.size() - kMaxDetectionsPerFrame;
    std::stable_sort(indices.begin(), indices.end(), [&](std::size_t a, std::size_t b) {
      return detections[a].score > detections[b].score;
    });
    indices.resize(kMaxDetectionsPerFrame);
    std::sort(indices.begin(), indices.end());
  }
  counts.detections += indices.size();
  return indices;
}

Bounds2 groundBounds(const Eigen::AlignedBox3d& box) {
  return {{box.min().x(), box.min().y()}, {box.max().x(), box.max().y()}};
}

Eigen::AlignedBox3d padded(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kBoxMargin_m);
  return {Eigen::Vector3d(box.min() - margin), Eigen::Vector3d(box.max() + margin)};
}

struct Common {
  double of_smaller = 0.0;  ///< Share of the smaller box both have in common.
  double of_union = 0.0;    ///< Intersection over union.
};

Common commonOf(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  const Eigen::AlignedBox3d one = padded(a);
  const Eigen::AlignedBox3d other = padded(b);
  const Eigen::AlignedBox3d both = one.intersection(other);
  if (both.isEmpty()) return {};
  const double common_m3 = both.volume();
  return {common_m3 / std::min(one.volume(), other.volume()),
          common_m3 / (one.volume() + other.volume() - common_m3)};
}

/// The class with the greatest sum; of equals the first by name.
std::string mostSeen(const std::map<std::string, double>& histogram) {
  const auto best =
      std::max_element(histogram.begin(), histogram.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == histogram.end() ? std::string() : best->first;
}

}  // namespace

ObjectLayer::ObjectLayer(const ObjectLayerConfig& config) : config_(config) {}

void ObjectLayer::restore(const SceneGraph& graph) {
  *this = ObjectLayer(config_);
  for (const auto& [id, node] : graph.nodes(NodeType::kObject)) {
    const Eigen::AlignedBox3d& box = objectIn(node).box;
    if (!box.isEmpty()) boxes_.insert(id, groundBounds(box));
  }
}

void ObjectLayer::observe(SceneGraph& graph, const std::vector<Detection>& detections,
                          double stamp_s) {
  for (const std::size_t index : usable(detections, counts_)) {
    const Detection& detection = detections[index];
    const std::optional<NodeId> known = config_.memory == ObjectMemory::kFirstSight
                                            ? matchAtFirstSight(graph, detection)
                                            : matchByBox(graph, detection);
    if (known) {
      absorb(graph, *known, detection, stamp_s);
    } else {
      add(graph, detection, stamp_s);
    }
  }
}

std::optional<NodeId> ObjectLayer::matchAtFirstSight(const SceneGraph& graph,
                                                     const Detection& detection) const {
  const std::string key = classKey(detection.class_name);
  const double reach_m = std::max(config_.merge_distance_m, config_.flicker_distance_m);
  std::optional<std::pair<double, NodeId>> of_class;
  std::optional<std::pair<double, NodeId>> of_any;
  const Point2 at{detection.centroid.x(), detection.centroid.y()};
  for (const NodeId id : graph.withinRadius(NodeType::kObject, at, reach_m)) {
    const Node& node = graph.at(id);
    const std::pair<double, NodeId> candidate{(node.position - detection.centroid).norm(), id};
    const bool is_same_class = !key.empty() && classKey(objectIn(node).class_name) == key;
    if (is_same_class && candidate.first <= config_.merge_distance_m)
      of_class = std::min(of_class.value_or(candidate), candidate);
    if (candidate.first <= config_.flicker_distance_m)
      of_any = std::min(of_any.value_or(candidate), candidate);
  }
  if (of_class) return of_class->second;
  if (of_any) return of_any->second;
  return std::nullopt;
}

std::optional<NodeId> ObjectLayer::matchByBox(const SceneGraph& graph,
                                              const Detection& detection) const {
  const std::string key = classKey(detection.class_name);
  // Another class comes last, then the greater overlap, then the older object.
  std::optional<std::tuple<bool, double, NodeId>> best;
  for (const NodeId id : boxes_.touching(groundBounds(padded(detection.box)))) {
    const Node* const node = graph.find(id);
    if (node == nullptr) continue;
    const Common common = commonOf(objectIn(*node).box, detection.box);
    const bool is_same_class = !key.empty() && classKey(objectIn(*node).class_name) == key;
    const bool matches =
        is_same_class ? common.of_smaller >= config_.min_common_box : common.of_union >= kSameThing;
    if (!matches) continue;
    const std::tuple<bool, double, NodeId> candidate{
        !is_same_class, -(is_same_class ? common.of_smaller : common.of_union), id};
    if (!best || candidate < *best) best = candidate;
  }
  if (!best) return std::nullopt;
  return std::get<2>(*best);
}

void ObjectLayer::add(SceneGraph& graph, const Detection& detection, double stamp_s) {
  ObjectAttributes object;
  object.class_name = detection.class_name;
  object.score = detection.score;
  object.observations = 1;
  object.box = detection.box;
  if (!detection.class_name.empty()) object.class_histogram[detection.class_name] = detection.score;
  const NodeId id = graph.add(detection.centroid, stamp_s, std::move(object)).id;
  boxes_.insert(id, groundBounds(detection.box));
}

void ObjectLayer::absorb(SceneGraph& graph, NodeId id, const Detection& detection, double stamp_s) {
  Node node = graph.at(id);
  auto& object = std::get<ObjectAttributes>(node.attributes);
  node.last_seen_s = std::max(node.last_seen_s, stamp_s);
  const double before = object.observations;
  ++object.observations;
  if (config_.memory == ObjectMemory::kFirstSight) {
    graph.update(std::move(node));
    return;
  }
  boxes_.erase(id, groundBounds(object.box));
  object.box.extend(detection.box);
  boxes_.insert(id, groundBounds(object.box));
  node.position = (before * node.position + detection.centroid) / (before + 1.0);
  object.score = (before * object.score + detection.score) / (before + 1.0);
  if (!detection.class_name.empty()) {
    object.class_histogram[detection.class_name] += detection.score;
    object.class_name = mostSeen(object.class_histogram);
  }
  free_checks_.erase(id);
  graph.update(std::move(node));
  mergeDuplicates(graph, id);
}

// A large object is first seen in pieces; once its box has grown over them they are one.
void ObjectLayer::mergeDuplicates(SceneGraph& graph, NodeId id) {
  const ObjectAttributes grown = objectIn(graph.at(id));
  const std::string key = classKey(grown.class_name);
  for (const NodeId other : boxes_.touching(groundBounds(grown.box))) {
    if (other == id || key.empty()) continue;
    const Node* const duplicate = graph.find(other);
    if (duplicate == nullptr || classKey(objectIn(*duplicate).class_name) != key) continue;
    if (commonOf(objectIn(*duplicate).box, grown.box).of_smaller < kSameThing) continue;
    Node kept = graph.at(std::min(id, other));
    const Node gone = graph.at(std::max(id, other));
    auto& object = std::get<ObjectAttributes>(kept.attributes);
    const double weight = object.observations;
    const double gone_weight = objectIn(gone).observations;
    const double sum = weight + gone_weight;
    kept.position = (weight * kept.position + gone_weight * gone.position) / sum;
    kept.created_s = std::min(kept.created_s, gone.created_s);
    kept.last_seen_s = std::max(kept.last_seen_s, gone.last_seen_s);
    object.score = (weight * object.score + gone_weight * objectIn(gone).score) / sum;
    object.observations += objectIn(gone).observations;
    for (const auto& [name, score] : objectIn(gone).class_histogram)
      object.class_histogram[name] += score;
    boxes_.erase(kept.id, groundBounds(object.box));
    object.box.extend(objectIn(gone).box);
    boxes_.insert(kept.id, groundBounds(object.box));
    const NodeId kept_id = kept.id;
    remove(graph, gone.id);
    graph.update(std::move(kept));
    ++counts_.merged;
    if (kept_id != id) return mergeDuplicates(graph, kept_id);
  }
}

void ObjectLayer::remove(SceneGraph& graph, NodeId id) {
  boxes_.erase(id, groundBounds(objectIn(graph.at(id)).box));
  free_checks_.erase(id);
  graph.remove(id);
}

void ObjectLayer::removeGhosts(SceneGraph& graph, const octomap::OcTree& map, const Point2& center,
                               double radius_m) {
  if (config_.ghosts == GhostRemoval::kNever) return;
  std::vector<NodeId> near = graph.withinRadius(NodeType::kObject, center, radius_m);
  std::sort(near.begin(), near.end());
  // In turn: those after the last one looked at come first.
  std::rotate(near.begin(), std::upper_bound(near.begin(), near.end(), last_checked_), near.end());
  if (near.size() > kGhostChecksPerCall) near.resize(kGhostChecksPerCall);
  for (const NodeId id : near) {
    last_checked_ = id;
    if (!isSeenThrough(map, objectIn(graph.at(id)).box)) {
      free_checks_.erase(id);
    } else if (++free_checks_[id] >= config_.ghost_checks) {
      remove(graph, id);
      ++counts_.ghosts;
    }
  }
}

}  // namespace occusg
