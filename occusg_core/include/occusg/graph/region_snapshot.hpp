// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <vector>

#include "occusg/geometry/polygon.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg {

enum class SnapshotState {
  kNone,   ///< There has been no usable region yet.
  kFresh,  ///< The regions are those of the last update.
  kStale,  ///< The last update was stale or empty; the regions are those of an earlier one.
};

/// The regions rooms can stand on: those of the last valid update that have an area. An empty
/// update after a valid one is taken for a failure, not for a world without free space.
class RegionSnapshot {
 public:
  struct Support {
    Region region;  ///< Area and centroid are those of its polygon.
    Bounds2 bounds;
  };

  void update(const TrackedRegions& tracked);

  [[nodiscard]] SnapshotState state() const { return state_; }
  [[nodiscard]] const std::map<int, Support>& regions() const { return regions_; }
  [[nodiscard]] const std::vector<Crossing>& crossings() const { return crossings_; }
  [[nodiscard]] bool has(int region) const { return regions_.count(region) > 0; }
  /// True when the region is there, or missing but still known to the tracker.
  [[nodiscard]] bool remembers(int region) const {
    return has(region) || missed_.count(region) > 0;
  }
  /// Where the last update changed, added or removed a region: its old bounds and its new ones.
  [[nodiscard]] const std::vector<Bounds2>& changes() const { return changes_; }

 private:
  void adopt(const TrackedRegions& tracked);

  SnapshotState state_ = SnapshotState::kNone;
  std::map<int, Support> regions_;  ///< By id.
  std::vector<Crossing> crossings_;
  std::set<int> missed_;
  std::vector<Bounds2> changes_;
};

}  // namespace occusg
