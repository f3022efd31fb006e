// SPDX-License-Identifier: BSD-3-Clause
#include "graph/object_layer.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "graph/class_key.hpp"
#include "graph/ghost_check.hpp"
#include "occusg/graph/limits.hpp"

namespace occusg {
namespace {

// Boxes of surfaces seen from one side are flat: without a margin flat boxes have nothing in
// common.
constexpr double kBoxMargin_m = 0.05;
// Objects of different classes so alike in place and size are one object the detector is unsure of,
// and detections of one frame are one thing found twice.
constexpr double kSameThing = 0.5;
// Neighbours are two things in every frame that shows both; a thing is two now and then, by mistake
// of the detector. Of the frames that show the one seen more often, at least so many:
constexpr double kShareApart = 0.1;
// Share of the smaller outline within the larger one, and gap in height, of pieces of an object.
constexpr double kWithinOutline = 0.8;
constexpr double kPieceGap_m = 0.5;
constexpr std::size_t kGhostChecksPerCall = 32;
// A kilometre-sized box is no object and would be listed everywhere.
constexpr double kLargestObject_m = 50.0;

const ObjectAttributes& objectIn(const Node& node) {
  return std::get<ObjectAttributes>(node.attributes);
}

bool isUsable(const Detection& detection) {
  const Eigen::AlignedBox3d& box = detection.box;
  return isWithinGraph(detection.centroid) && isWithinGraph(box.min()) &&
         isWithinGraph(box.max()) && !box.isEmpty() && box.sizes().maxCoeff() <= kLargestObject_m &&
         detection.score >= 0.0 && detection.score <= 1.0;
}

/// The usable detections, the best if there are too many, in their order.
std::vector<const Detection*> usable(const std::vector<Detection>& detections,
                                     ObjectCounts& counts) {
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
  std::vector<const Detection*> result;
  result.reserve(indices.size());
  for (const std::size_t index : indices) result.push_back(&detections[index]);
  return result;
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

bool isSameTwice(const Detection& a, const Detection& b) {
  return commonOf(a.box, b.box).of_union >= kSameThing;
}

bool isSameClass(const Detection& a, const Detection& b) {
  const std::string key = classKey(a.class_name);
  return !key.empty() && classKey(b.class_name) == key;
}

Eigen::AlignedBox2d groundBox(const Eigen::AlignedBox3d& box) {
  return {Eigen::Vector2d(box.min().head<2>()), Eigen::Vector2d(box.max().head<2>())};
}

/// Share of the smaller box's outline on the ground that lies within the other's.
double commonOutline(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
  const Eigen::AlignedBox2d one = groundBox(padded(a));
  const Eigen::AlignedBox2d other = groundBox(padded(b));
  const Eigen::AlignedBox2d both = one.intersection(other);
  if (both.isEmpty()) return 0.0;
  return both.volume() / std::min(one.volume(), other.volume());
}

/// The class with the greatest sum; of equals the first by name.
std::string mostSeen(const std::map<std::string, double>& histogram) {
  const auto best =
      std::max_element(histogram.begin(), histogram.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == histogram.end() ? std::string() : best->first;
}

}  // namespace

ObjectLayer::ObjectLayer(const ObjectLayerConfig& config) : config_(checked(config)) {}

ObjectLayerState ObjectLayer::state() const {
  return {apart_.pairs(), free_checks_, last_checked_};
}

void ObjectLayer::restore(const SceneGraph& graph, const ObjectLayerState& state) {
  *this = ObjectLayer(config_);
  apart_ = SeenApart(state.seen_apart);
  free_checks_ = state.free_checks;
  last_checked_ = state.last_checked;
  for (const auto& [id, node] : graph.nodes(NodeType::kObject)) {
    const Eigen::AlignedBox3d& box = objectIn(node).box;
    if (!box.isEmpty()) boxes_.insert(id, groundBounds(box));
  }
}

void ObjectLayer::observe(SceneGraph& graph, const std::vector<Detection>& detections,
                          double stamp_s) {
  const Frame frame = usable(detections, counts_);
  if (config_.memory == ObjectMemory::kFirstSight) {
    observeAtFirstSight(graph, frame, stamp_s);
  } else {
    observeRunning(graph, frame, stamp_s);
  }
}

void ObjectLayer::observeAtFirstSight(SceneGraph& graph, const Frame& frame, double stamp_s) {
  for (const Detection* const detection : frame) {
    if (const std::optional<NodeId> known = matchAtFirstSight(graph, *detection)) {
      absorb(graph, *known, *detection, stamp_s);
    } else {
      add(graph, *detection, stamp_s);
    }
  }
}

void ObjectLayer::observeRunning(SceneGraph& graph, const Frame& frame, double stamp_s) {
  Objects object_of = matchByBox(graph, frame);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    for (std::size_t j = 0; !object_of[i] && j < i; ++j) {
      if (isSameClass(*frame[i], *frame[j]) && isSameTwice(*frame[i], *frame[j]))
        object_of[i] = object_of[j];
    }
    if (object_of[i]) {
      absorb(graph, *object_of[i], *frame[i], stamp_s);
    } else {
      object_of[i] = add(graph, *frame[i], stamp_s);
    }
  }
  noteApart(graph, frame, object_of);
  for (const std::optional<NodeId>& object : object_of)
    if (graph.find(*object) != nullptr) mergeDuplicates(graph, *object);
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

// The best pairs of the whole frame come first: same class, then the greater overlap.
ObjectLayer::Objects ObjectLayer::matchByBox(const SceneGraph& graph, const Frame& frame) const {
  std::vector<std::tuple<bool, double, std::size_t, NodeId>> pairs;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const std::string key = classKey(frame[i]->class_name);
    for (const NodeId id : boxes_.touching(groundBounds(padded(frame[i]->box)))) {
      const Node* const node = graph.find(id);
      if (node == nullptr) continue;
      const Common common = commonOf(objectIn(*node).box, frame[i]->box);
      const bool is_same_class = !key.empty() && classKey(objectIn(*node).class_name) == key;
      if (is_same_class && common.of_smaller >= config_.min_common_box)
        pairs.emplace_back(false, -common.of_smaller, i, id);
      if (!is_same_class && common.of_union >= kSameThing)
        pairs.emplace_back(true, -common.of_union, i, id);
    }
  }
  std::sort(pairs.begin(), pairs.end());

  Objects object_of(frame.size());
  std::map<NodeId, std::size_t> taken_by;
  for (const auto& [is_other_class, overlap, i, id] : pairs) {
    if (object_of[i]) continue;
    const auto [taken, is_first] = taken_by.emplace(id, i);
    if (is_first || isSameTwice(*frame[taken->second], *frame[i])) object_of[i] = id;
  }
  return object_of;
}

NodeId ObjectLayer::add(SceneGraph& graph, const Detection& detection, double stamp_s) {
  ObjectAttributes object;
  object.class_name = detection.class_name;
  object.score = detection.score;
  object.observations = 1;
  object.box = detection.box;
  if (!detection.class_name.empty()) object.class_histogram[detection.class_name] = detection.score;
  const NodeId id = graph.add(detection.centroid, stamp_s, std::move(object)).id;
  boxes_.insert(id, groundBounds(detection.box));
  return id;
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
}

void ObjectLayer::noteApart(const SceneGraph& graph, const Frame& frame, const Objects& object_of) {
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Eigen::AlignedBox3d box = padded(objectIn(graph.at(*object_of[i])).box);
    for (std::size_t j = 0; j < i; ++j) {
      if (object_of[i] == object_of[j] || !isSameClass(*frame[i], *frame[j])) continue;
      const bool are_beside =
          groundBox(box).intersects(groundBox(objectIn(graph.at(*object_of[j])).box));
      if (are_beside && !isSameTwice(*frame[i], *frame[j]))
        apart_.add(*object_of[i], *object_of[j]);
    }
  }
}

// A large object is first seen in pieces: its box has grown over them, or they stand below or above
// it within its outline, as the legs of a table whose top was seen at another time. Two things that
// are seen as two in the same frames are none.
bool ObjectLayer::areOne(const Node& object, const Node& other) const {
  const std::string key = classKey(objectIn(object).class_name);
  if (key.empty() || classKey(objectIn(other).class_name) != key) return false;
  const int looks = std::max(objectIn(object).observations, objectIn(other).observations);
  if (apart_.count(object.id, other.id) > kShareApart * looks) return false;
  const Eigen::AlignedBox3d& a = objectIn(object).box;
  const Eigen::AlignedBox3d& b = objectIn(other).box;
  if (commonOf(a, b).of_smaller >= kSameThing) return true;
  const double gap_m = std::max(a.min().z(), b.min().z()) - std::min(a.max().z(), b.max().z());
  return gap_m <= kPieceGap_m && commonOutline(a, b) >= kWithinOutline;
}

void ObjectLayer::mergeDuplicates(SceneGraph& graph, NodeId id) {
  const Node grown = graph.at(id);
  for (const NodeId other : boxes_.touching(groundBounds(objectIn(grown).box))) {
    const Node* const duplicate = other == id ? nullptr : graph.find(other);
    if (duplicate == nullptr || !areOne(grown, *duplicate)) continue;
    const NodeId kept = merge(graph, id, other);
    if (kept != id) return mergeDuplicates(graph, kept);
  }
}

NodeId ObjectLayer::merge(SceneGraph& graph, NodeId id, NodeId other) {
  Node kept = graph.at(std::min(id, other));
  const Node gone = graph.at(std::max(id, other));
  const NodeId kept_id = kept.id;
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
  boxes_.erase(kept_id, groundBounds(object.box));
  object.box.extend(objectIn(gone).box);
  boxes_.insert(kept_id, groundBounds(object.box));
  apart_.merge(kept_id, gone.id);
  remove(graph, gone.id);
  graph.update(std::move(kept));
  ++counts_.merged;
  return kept_id;
}

void ObjectLayer::remove(SceneGraph& graph, NodeId id) {
  boxes_.erase(id, groundBounds(objectIn(graph.at(id)).box));
  free_checks_.erase(id);
  apart_.erase(id);
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
