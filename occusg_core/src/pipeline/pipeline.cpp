// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/pipeline.hpp"

#include <cmath>
#include <utility>

#include "occusg/error.hpp"
#include "pipeline/building_graph.hpp"

namespace occusg {
namespace {

// Stamps are read from decimal text: 0.5 s may arrive as 0.49999999.
constexpr double kStampTolerance_s = 1e-6;

/// Regions and rooms follow a change of the layer within this time.
constexpr double kSettling_s = 10.0;

RoomCounts operator+(RoomCounts sum, const RoomCounts& counts) {
  sum.region_updates += counts.region_updates;
  sum.rejected_region_updates += counts.rejected_region_updates;
  sum.objects.detections += counts.objects.detections;
  sum.objects.refused += counts.objects.refused;
  sum.objects.over_limit += counts.objects.over_limit;
  sum.objects.merged += counts.objects.merged;
  sum.objects.ghosts += counts.objects.ghosts;
  sum.room_id_switches += counts.room_id_switches;
  return sum;
}

void add(RefusedMasks& sum, const RefusedMasks& refused) {
  for (std::size_t i = 0; i < kMaskRefusalCount; ++i) {
    const auto reason = static_cast<MaskRefusal>(i);
    sum.add(
        reason, [&] { return refused.first(reason); }, refused.count(reason));
  }
}

}  // namespace

Pipeline::Pipeline(const PipelineConfig& config, std::unique_ptr<Decomposer> decomposer)
    : config_(config),
      detection_builder_(config.detection),
      map_(config, decomposer ? Storeys::kOne : Storeys::kFound),
      changed_at_s_(1, 0.0) {
  rooms_.emplace_back(config, std::move(decomposer));
}

void Pipeline::startFrom(OccupancyMap map) {
  if (last_stamp_s_)
    throw refuse("map", "comes after the first frame", "a map to start from comes before it");
  map_.startFrom(std::move(map));
}

void Pipeline::resume(Session session) {
  if (!session.map) throw refuse("session", "has no map", "the map it goes with is needed");
  startFrom(std::move(*session.map));
  rooms_.front().resumeFrom(session.state);
  last_room_update_s_ = session.state.last_room_update_s;
  last_stamp_s_ = session.state.stamp_s;
  last_pose_ = session.state.T_map_agent;
}

SessionState Pipeline::sessionState(const std::string& scene) const {
  if (!last_stamp_s_) throw refuse("session", "has no frame", "one frame at least is needed");
  if (rooms_.size() > 1) {
    throw refuse("session", "the building has " + std::to_string(rooms_.size()) + " storeys",
                 "a session holds one storey; keep map.ot and continue with --map");
  }
  SessionState state;
  state.scene = scene;
  state.stamp_s = *last_stamp_s_;
  state.T_map_agent = last_pose_;
  rooms_.front().saveTo(state);
  return state;
}

FrameReport Pipeline::process(const DepthFrame& frame) {
  checkStamp(frame);
  return takeIn(frame, {});
}

FrameReport Pipeline::process(const DepthFrame& frame, const InstanceMasks& masks) {
  checkStamp(frame);
  return takeIn(frame, detection_builder_.build(masks, frame));
}

void Pipeline::checkStamp(const DepthFrame& frame) const {
  if (!std::isfinite(frame.stamp_s))
    throw refuse("frame", "its stamp is not a number", "seconds are needed");
  if (last_stamp_s_ && frame.stamp_s <= *last_stamp_s_) {
    throw refuse("frame",
                 "its stamp " + shortestText(frame.stamp_s) + " s is not after " +
                     shortestText(*last_stamp_s_) + " s",
                 "frames must come in order of time");
  }
}

FrameReport Pipeline::takeIn(const DepthFrame& frame, const DetectionResult& objects) {
  const FrameReport report = timed(totals_, Stage::kTotal, [&] {
    FrameReport taken = map_.process(frame);
    if (!taken.hasUsablePose()) return taken;
    building_.reset();
    followStoreys();
    last_stamp_s_ = frame.stamp_s;
    last_pose_ = frame.T_map_camera;
    observeObjects(objects.detections, frame.stamp_s);
    if (roomsAreDue(frame.stamp_s)) {
      updateRooms(frame.T_map_camera, frame.stamp_s);
      taken.rooms_updated = true;
    } else {
      skipIdsOfOthers(map_.currentStorey());
      rooms_[map_.currentStorey()].observePose(frame.T_map_camera, frame.stamp_s);
    }
    return taken;
  });
  add(refused_masks_, objects.refused);
  return report;
}

void Pipeline::followStoreys() {
  while (rooms_.size() < map_.storeys().size()) {
    rooms_.emplace_back(config_);
    changed_at_s_.push_back(0.0);
  }
}

void Pipeline::observeObjects(const std::vector<Detection>& detections, double stamp_s) {
  if (rooms_.size() == 1) {
    rooms_.front().observeObjects(detections, stamp_s);
    return;
  }
  std::vector<std::vector<Detection>> by_storey(rooms_.size());
  for (const Detection& detection : detections)
    by_storey[storeyAtHeight(detection.centroid.z())].push_back(detection);
  for (std::size_t storey = 0; storey < rooms_.size(); ++storey) {
    if (by_storey[storey].empty()) continue;
    skipIdsOfOthers(storey);
    rooms_[storey].observeObjects(by_storey[storey], stamp_s);
  }
}

/// Index of the storey between whose slabs the height is; of the current one for a NaN.
std::size_t Pipeline::storeyAtHeight(double z_m) const {
  for (std::size_t storey = 0; storey < storeys().size(); ++storey)
    if (storeys()[storey].span.holds(z_m)) return storey;
  return map_.currentStorey();
}

void Pipeline::skipIdsOfOthers(std::size_t storey) {
  for (std::size_t other = 0; other < rooms_.size(); ++other)
    if (other != storey) rooms_[storey].skipIdsOf(rooms_[other].graph());
}

MapView Pipeline::mapView(std::size_t storey, const LayerChange& change) const {
  return {&freeSpace(storey), change.cells, &occupancyMap().tree(), config_.occupancy.max_range_m,
          change.gaps};
}

void Pipeline::finish() {
  if (!last_stamp_s_) return;
  building_.reset();
  if (last_room_update_s_ != last_stamp_s_) updateRooms(last_pose_, *last_stamp_s_);
  for (std::size_t storey = 0; storey < rooms_.size(); ++storey) {
    skipIdsOfOthers(storey);
    rooms_[storey].finish(*last_stamp_s_, mapView(storey, {}));
  }
}

bool Pipeline::roomsAreDue(double stamp_s) const {
  return !last_room_update_s_ ||
         stamp_s - *last_room_update_s_ >= config_.region_period_s - kStampTolerance_s;
}

void Pipeline::updateRooms(const Pose& T_map_camera, double stamp_s) {
  for (std::size_t storey = 0; storey < rooms_.size(); ++storey)
    updateRoomsOf(storey, T_map_camera, stamp_s);
  last_room_update_s_ = stamp_s;
}

/// A storey the robot is not on rests once its rooms have followed its last change.
void Pipeline::updateRoomsOf(std::size_t storey, const Pose& T_map_camera, double stamp_s) {
  const LayerChange change = map_.takeChange(storey);
  if (!change.cells.empty() || !change.gaps.empty()) changed_at_s_[storey] = stamp_s;
  const bool is_attended = storey == map_.currentStorey();
  if (!is_attended && stamp_s - changed_at_s_[storey] > kSettling_s) return;
  skipIdsOfOthers(storey);
  const MapView view = mapView(storey, change);
  if (is_attended) {
    rooms_[storey].update(view, T_map_camera, stamp_s);
  } else {
    rooms_[storey].updateUnattended(view, stamp_s);
  }
}

void Pipeline::setRoomLabel(NodeId room, const std::string& label) {
  building_.reset();
  for (RoomPipeline& rooms : rooms_)
    if (rooms.graph().find(room) != nullptr) return rooms.setRoomLabel(room, label);
  rooms_.front().setRoomLabel(room, label);
}

const SceneGraph& Pipeline::graph() const {
  if (rooms_.size() == 1) return rooms_.front().graph();
  if (!building_) {
    std::vector<StoreyGraph> graphs;
    for (std::size_t storey = 0; storey < rooms_.size(); ++storey)
      graphs.push_back({&rooms_[storey].graph(), storeys()[storey]});
    building_ = buildingGraph(graphs, map_.passages(), config_.graph.rooms.floor_z_m);
  }
  return *building_;
}

PipelineCounts Pipeline::counts() const {
  RoomCounts rooms;
  for (const RoomPipeline& storey : rooms_) rooms = rooms + storey.counts();
  return {map_.counts(), rooms, refused_masks_};
}

StageTimes Pipeline::times() const {
  StageTimes times = totals_;
  times.merge(map_.times());
  for (const RoomPipeline& rooms : rooms_) times.merge(rooms.times());
  return times;
}

}  // namespace occusg
