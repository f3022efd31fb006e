// SPDX-License-Identifier: BSD-3-Clause
#include "occusg_ros/waiting_map.hpp"

#include <algorithm>
#include <cstddef>

namespace occusg_ros {
namespace {

// They are published before the grid; this long only when they are lost or slow.
constexpr double kPatience_s = 0.5;
// Those of the grid that waits and of the one to come.
constexpr std::size_t kKeptGaps = 2;

}  // namespace

bool WaitingMap::takeGrid(const nav_msgs::OccupancyGridConstPtr& grid, double arrived_s) {
  const bool gives_way = waiting_.has_value();
  waiting_ = Map{grid, gapsOf(*grid), arrived_s};
  used_without_gaps_.reset();
  return gives_way;
}

void WaitingMap::takeGaps(const occusg::OverheadGapsConstPtr& gaps, double arrived_s) {
  gaps_.push_back(gaps);
  if (gaps_.size() > kKeptGaps) gaps_.pop_front();
  if (waiting_) {
    if (waiting_->grid->header.stamp == gaps->header.stamp) waiting_->gaps = gaps;
  } else if (used_without_gaps_ && used_without_gaps_->header.stamp == gaps->header.stamp) {
    waiting_ = Map{used_without_gaps_, gaps, arrived_s};
    used_without_gaps_.reset();
  }
}

std::optional<WaitingMap::Map> WaitingMap::ready(GapsPublished published, double now_s) const {
  if (!waiting_) return std::nullopt;
  const bool may_come =
      published == GapsPublished::kYes && now_s - waiting_->arrived_s < kPatience_s;
  if (!waiting_->gaps && may_come) return std::nullopt;
  return waiting_;
}

void WaitingMap::noteUsed(const Map& map) {
  if (!waiting_ || waiting_->grid != map.grid || waiting_->gaps != map.gaps) return;
  if (!map.gaps) used_without_gaps_ = map.grid;
  waiting_.reset();
}

occusg::OverheadGapsConstPtr WaitingMap::gapsOf(const nav_msgs::OccupancyGrid& grid) const {
  const auto found = std::find_if(gaps_.rbegin(), gaps_.rend(), [&](const auto& gaps) {
    return gaps->header.stamp == grid.header.stamp;
  });
  return found == gaps_.rend() ? nullptr : *found;
}

}  // namespace occusg_ros
