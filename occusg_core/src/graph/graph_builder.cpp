// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/graph_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr double kStampRoundingS = 1e-6;

}  // namespace

GraphBuilder::GraphBuilder(const GraphBuilderConfig& config)
    : config_(config), agents_(config.agents), rooms_(config.rooms) {}

const SceneGraph& GraphBuilder::update(const TrackedRegions& tracked, const Pose& T_map_camera,
                                       double stamp_s) {
  observePose(T_map_camera, stamp_s);
  if (last_update_s_ && stamp_s < *last_update_s_) {
    ++updates_back_in_time_;
    return graph_;
  }
  if (!last_update_s_) last_maintenance_s_ = stamp_s;
  last_update_s_ = stamp_s;
  const bool is_due =
      stamp_s - last_maintenance_s_ >= config_.maintenance_period_s - kStampRoundingS;
  if (is_due) last_maintenance_s_ = stamp_s;
  const Eigen::Vector3d robot = T_map_camera.translation();
  rooms_.update(graph_, tracked, {robot.x(), robot.y()}, stamp_s,
                is_due ? Maintenance::kDue : Maintenance::kNotDue);
  return graph_;
}

void GraphBuilder::observePose(const Pose& T_map_camera, double stamp_s) {
  agents_.observe(graph_, T_map_camera, stamp_s);
}

const SceneGraph& GraphBuilder::finish(double stamp_s) {
  if (!std::isfinite(stamp_s))
    throw refuse("graph", "the last stamp is not finite", "seconds are expected");
  rooms_.finish(graph_, std::max(stamp_s, last_update_s_.value_or(stamp_s)));
  return graph_;
}

GraphBuilderState GraphBuilder::state() const {
  return {graph_, rooms_.state(), last_update_s_, last_maintenance_s_};
}

void GraphBuilder::restore(GraphBuilderState state, double stamp_s) {
  reset();
  graph_ = std::move(state.graph);
  agents_.restore(graph_, stamp_s);
  rooms_.restore(graph_, state.rooms);
  last_update_s_ = state.last_update_s;
  last_maintenance_s_ = state.last_maintenance_s;
}

void GraphBuilder::reset() { *this = GraphBuilder(config_); }

}  // namespace occusg
