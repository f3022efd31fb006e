// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <occusg/OverheadGaps.h>

#include <deque>
#include <optional>

namespace occusg_ros {

/// Whether somebody publishes what hangs over the floor of the free space.
enum class GapsPublished { kNo, kYes };

/// The newest free space that waits for its turn, and what hangs over its floor: two messages of
/// one stamp on two topics, which may arrive in either order, and one of them late or never.
class WaitingMap {
 public:
  struct Map {
    nav_msgs::OccupancyGridConstPtr grid;
    occusg::OverheadGapsConstPtr gaps;  ///< Null: none came.
    double arrived_s = 0.0;             ///< Of the grid; steady clock [s].
  };

  /// True when one that waited gave way to this newer one.
  bool takeGrid(const nav_msgs::OccupancyGridConstPtr& grid, double arrived_s);

  /// Gaps whose grid was used without them bring it back, unless a newer one waits.
  void takeGaps(const occusg::OverheadGapsConstPtr& gaps, double arrived_s);

  /// The map that waits, once it has its gaps or they need not be waited for any longer.
  [[nodiscard]] std::optional<Map> ready(GapsPublished published, double now_s) const;

  /// `map` has been used; a newer one that arrived meanwhile keeps waiting.
  void noteUsed(const Map& map);

  [[nodiscard]] bool empty() const { return !waiting_; }
  void clear() { *this = {}; }

 private:
  [[nodiscard]] occusg::OverheadGapsConstPtr gapsOf(const nav_msgs::OccupancyGrid& grid) const;

  std::optional<Map> waiting_;
  nav_msgs::OccupancyGridConstPtr used_without_gaps_;
  std::deque<occusg::OverheadGapsConstPtr> gaps_;  ///< Newest last.
};

}  // namespace occusg_ros
