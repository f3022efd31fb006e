// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/pipeline.hpp"

#include <cmath>
#include <utility>

#include "occusg/error.hpp"

namespace occusg {
namespace {

// Stamps are read from decimal text: 0.5 s may arrive as 0.49999999.
constexpr double kStampTolerance_s = 1e-6;

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
      storeys_(decomposer ? Storeys::kOne : Storeys::kFound),
      detection_builder_(config.detection),
      map_(config, storeys_),
      rooms_(config, std::move(decomposer)) {}

void Pipeline::startFrom(OccupancyMap map) {
  if (last_stamp_s_)
    throw refuse("map", "comes after the first frame", "a map to start from comes before it");
  map_.startFrom(std::move(map));
}

void Pipeline::resume(Session session) {
  if (!session.map) throw refuse("session", "has no map", "the map it goes with is needed");
  if (last_stamp_s_)
    throw refuse("session", "comes after the first frame", "a session to resume comes before it");
  const std::size_t storeys = session.state.building.storeys.size();
  if (storeys_ == Storeys::kOne && storeys > 1) {
    throw refuse("session", "has " + std::to_string(storeys) + " storeys",
                 "with a decomposer of its own a pipeline has one");
  }
  map_.startFrom(std::move(*session.map), session.state.building);
  rooms_.resumeFrom(session.state);
  last_room_update_s_ = rooms_.lastUpdate();
  last_stamp_s_ = session.state.stamp_s;
  last_pose_ = session.state.T_map_agent;
}

SessionState Pipeline::sessionState(const std::string& scene) const {
  if (!last_stamp_s_) throw refuse("session", "has no frame", "one frame at least is needed");
  SessionState state;
  state.scene = scene;
  state.stamp_s = *last_stamp_s_;
  state.T_map_agent = last_pose_;
  rooms_.saveTo(state);
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
    rooms_.follow(map_.building());
    last_stamp_s_ = frame.stamp_s;
    last_pose_ = frame.T_map_camera;
    rooms_.observeObjects(objects.detections, frame.stamp_s);
    if (roomsAreDue(frame.stamp_s)) {
      updateRooms(frame.T_map_camera, frame.stamp_s);
      taken.rooms_updated = true;
    } else {
      rooms_.observePose(frame.T_map_camera, frame.stamp_s);
    }
    return taken;
  });
  add(refused_masks_, objects.refused);
  return report;
}

MapView Pipeline::mapView(std::size_t storey, const LayerChange& change) const {
  return {&freeSpace(storey), change.cells, &occupancyMap().tree(), config_.occupancy.max_range_m,
          change.gaps};
}

void Pipeline::finish() {
  if (!last_stamp_s_) return;
  if (last_room_update_s_ != last_stamp_s_) updateRooms(last_pose_, *last_stamp_s_);
  for (std::size_t storey = 0; storey < rooms_.storeyCount(); ++storey)
    rooms_.finish(storey, *last_stamp_s_, mapView(storey, {}));
}

bool Pipeline::roomsAreDue(double stamp_s) const {
  return !last_room_update_s_ ||
         stamp_s - *last_room_update_s_ >= config_.region_period_s - kStampTolerance_s;
}

void Pipeline::updateRooms(const Pose& T_map_camera, double stamp_s) {
  for (std::size_t storey = 0; storey < rooms_.storeyCount(); ++storey)
    rooms_.update(storey, mapView(storey, map_.takeChange(storey)), T_map_camera, stamp_s);
  last_room_update_s_ = stamp_s;
}

void Pipeline::setRoomLabel(NodeId room, const std::string& label) {
  rooms_.setRoomLabel(room, label);
}

PipelineCounts Pipeline::counts() const { return {map_.counts(), rooms_.counts(), refused_masks_}; }

StageTimes Pipeline::times() const {
  StageTimes times = totals_;
  times.merge(map_.times());
  times.merge(rooms_.times());
  return times;
}

}  // namespace occusg
