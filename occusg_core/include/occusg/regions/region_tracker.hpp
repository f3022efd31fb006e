// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

class AcceptanceGuard;

/// Which decompositions are refused for what they lost.
struct AcceptanceGuardConfig {
  double max_area_drop = 0.15;   ///< Largest accepted drop of the total area, 0..1, inclusive.
  double max_count_drop = 0.15;  ///< Largest accepted drop of the number of regions, 0..1.
  /// The paper rejects when either drops. Two rooms of five that merge are 20 % of the regions and
  /// no area at all; that must not freeze a map, so by default the area alone decides.
  bool reject_on_count_alone = false;
  /// After so many rejections in a row the new state is accepted; 0 = never (as in the paper).
  int max_rejections_in_a_row = 6;
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(AcceptanceGuardConfig& config);

/// When a region continues a track.
struct RegionTrackerConfig {
  double min_overlap = 0.20;  ///< Polygon IoU must exceed this, 0..1.
  /// Centroids must be nearer than this [m] (paper: 1.5). Infinite, as where a corridor is cut in
  /// two the centroids of both parts lie metres from its own, and its id would go with neither.
  double max_centroid_distance_m = std::numeric_limits<double>::infinity();
  double min_area_ratio = 0.25;  ///< New area over old area, lower bound, inclusive.
  double max_area_ratio = 4.0;   ///< Upper bound, inclusive.
  int max_missed_updates = 3;    ///< A track survives so many updates without a region.
  AcceptanceGuardConfig guard;
};

/// The one table of these parameters: names, units, ranges and what they mean. The constructor
/// checks the ranges; YAML files, ROS parameters and the pages of the documentation come from it.
/// @param config outlives the parameters, which read and write it.
[[nodiscard]] std::vector<Parameter> parametersOf(RegionTrackerConfig& config);

/// Regions with lasting ids.
struct TrackedRegions {
  /// Region, adjacency, crossing and label ids are track ids; regions are ordered by id.
  Decomposition decomposition;
  std::vector<int> missed;  ///< Tracks without a region now but still remembered; sorted.
  /// Counts the accepted decompositions, so that a follower sees whether it missed one.
  /// Zero: not counted, and `changed` says nothing.
  std::uint64_t update = 0;
  /// Regions that are new, have another polygon, or are gone since update `update` - 1; sorted.
  std::vector<int> changed;
  /// Whether crossings differ from those of update `update` - 1.
  bool crossings_changed = true;
  bool stale = false;  ///< The newest decomposition was rejected; this is the last accepted one.
};

/// What a tracker knows that the next decomposition does not tell it again.
struct RegionTrackerState {
  /// One region that lasts.
  struct Track {
    int id = 0;
    int missed_updates = 0;
    Polygon polygon;  ///< As last seen.
  };
  std::vector<Track> tracks;  ///< By id.
  int next_id = 1;
};

/// Gives regions ids that last from update to update (paper, Sec. 3.3). A region continues the
/// track it overlaps most among those that pass all three gates, one to one; ties go to the nearer
/// centroid, then to the older track. Of a region that was split the part it overlaps most keeps
/// its id, and of regions that merged the whole keeps the id of the largest. A matched track takes
/// the new geometry; a region without a match starts a new track; ids count up from 1 and are never
/// used again.
class RegionTracker {
 public:
  /// @throws Error when a parameter is out of range.
  explicit RegionTracker(const RegionTrackerConfig& config);
  RegionTracker(const RegionTracker&) = delete;
  RegionTracker& operator=(const RegionTracker&) = delete;
  RegionTracker(RegionTracker&&) noexcept;
  RegionTracker& operator=(RegionTracker&&) noexcept;
  ~RegionTracker();

  /// A decomposition the guard rejects leaves the tracks alone: the last accepted state comes back,
  /// marked stale. The reference stays valid until the next call.
  const TrackedRegions& update(const Decomposition& decomposition);
  [[nodiscard]] const TrackedRegions& regions() const { return tracked_; }
  [[nodiscard]] RegionTrackerState state() const;
  /// Goes on with the tracks of another tracker; there are no regions until the next update, which
  /// the guard accepts.
  /// @pre ids rise, and are positive and below `next_id`.
  void restore(const RegionTrackerState& state);
  /// Forgets all tracks; ids start at 1 again.
  void reset();

 private:
  struct Track {
    Region region;  ///< As last seen.
    int missed_updates = 0;
  };

  [[nodiscard]] bool mayContinue(const Track& track, const Region& region) const;
  /// Whether the decomposition says which regions of the last one it has.
  [[nodiscard]] bool knowsWhatIsSame(const Decomposition& decomposition) const;
  /// The track of every region that has not changed since it was last seen; zero for the others.
  [[nodiscard]] std::vector<int> assignUnchanged(const Decomposition& decomposition) const;
  /// The track of every region in list order: a known one, or one that it starts.
  [[nodiscard]] std::vector<int> assign(const Decomposition& decomposition);
  void step(const std::vector<Region>& regions, const std::vector<int>& ids);
  [[nodiscard]] Grid<std::int32_t> labelsAfter(const Decomposition& decomposition,
                                               const std::vector<std::int32_t>& new_id);
  void noteChanges(const Decomposition& decomposition, const std::vector<int>& ids);

  RegionTrackerConfig config_;
  std::unique_ptr<AcceptanceGuard> guard_;
  std::map<int, Track> tracks_;  ///< By id.
  int next_id_ = 1;
  TrackedRegions tracked_;
  std::uint64_t last_update_ = 0;  ///< Of the decomposition `tracked_` is made of.
  std::vector<int> last_ids_;      ///< By its regions: the tracks.
};

}  // namespace occusg
