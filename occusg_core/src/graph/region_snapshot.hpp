// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "occusg/geometry/polygon.hpp"
#include "occusg/graph/spatial_index.hpp"
#include "occusg/regions/region_tracker.hpp"

namespace occusg {

enum class SnapshotState {
  kNone,   ///< There has been no usable region yet.
  kFresh,  ///< The regions are those of the last update.
  kStale,  ///< The last update was stale or empty; the regions are those of an earlier one.
};

/// Two regions, the smaller id first.
using RegionPair = std::pair<int, int>;

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
  /// Where the two regions meet, in the order of the decomposition.
  [[nodiscard]] std::vector<Segment2> crossingsBetween(const RegionPair& regions) const;
  /// Ids of the regions whose bounds touch `box`, sorted.
  [[nodiscard]] std::vector<int> touching(const Bounds2& box) const;
  [[nodiscard]] bool has(int region) const { return regions_.count(region) > 0; }
  /// True when the region is there, or missing but still known to the tracker.
  [[nodiscard]] bool remembers(int region) const {
    return has(region) || missed_.count(region) > 0;
  }
  /// Where the last update changed, added or removed a region: its old bounds and its new ones.
  [[nodiscard]] const std::vector<Bounds2>& changes() const { return changes_; }
  /// The regions the last update changed, added or removed; sorted.
  [[nodiscard]] const std::vector<int>& changedRegions() const { return changed_regions_; }
  /// The pairs of regions whose crossings the last update changed; sorted.
  [[nodiscard]] const std::vector<RegionPair>& changedContacts() const { return changed_contacts_; }

 private:
  void adoptAll(const TrackedRegions& tracked);
  void adoptChanged(const TrackedRegions& tracked);
  void adoptRegion(const Region& region);
  void dropRegion(int region);
  void noteMissed(const std::vector<int>& missed);
  void adoptCrossings(std::vector<Crossing> crossings);

  SnapshotState state_ = SnapshotState::kNone;
  std::map<int, Support> regions_;   ///< By id.
  SpatialIndex index_;               ///< Of their bounds.
  std::vector<Crossing> crossings_;  ///< Ordered by the regions.
  std::set<int> missed_;             ///< By the tracker, or without an area.
  std::set<int> unusable_;    ///< There, but without an area: their tracks live, so must the rooms.
  std::uint64_t update_ = 0;  ///< Of the tracker; zero: not known.
  std::vector<Bounds2> changes_;
  std::vector<int> changed_regions_;
  std::vector<RegionPair> changed_contacts_;
};

}  // namespace occusg
