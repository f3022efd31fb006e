// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/region_tracker.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>

#include "occusg/geometry/polygon_overlap.hpp"
#include "regions/acceptance_guard.hpp"

namespace occusg {
namespace {

constexpr int kNoTrack = 0;

/// A region that may continue a track.
struct Candidate {
  double overlap = 0.0;
  double distance_m = 0.0;
  int track = kNoTrack;
  std::size_t region = 0;

  /// Best first.
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return std::tie(b.overlap, a.distance_m, a.track, a.region) <
           std::tie(a.overlap, b.distance_m, b.track, b.region);
  }
};

bool haveSameRings(const Region& a, const Region& b) {
  return a.polygon.outer == b.polygon.outer && a.polygon.holes == b.polygon.holes;
}

bool areSame(const std::vector<Crossing>& a, const std::vector<Crossing>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& c, const auto& d) {
    return c.region_a == d.region_a && c.region_b == d.region_b && c.segment.a == d.segment.a &&
           c.segment.b == d.segment.b;
  });
}

bool areApart(const Bounds2& a, const Bounds2& b) {
  return a.max.x <= b.min.x || b.max.x <= a.min.x || a.max.y <= b.min.y || b.max.y <= a.min.y;
}

/// `decomposition` with region ids replaced: ids[i] for the i-th region.
Decomposition renamed(const Decomposition& decomposition, const std::vector<int>& ids) {
  std::vector<std::int32_t> new_id(ids.size() + 1, kNoRegion);
  std::copy(ids.begin(), ids.end(), new_id.begin() + 1);
  Decomposition result = decomposition;
  for (Region& region : result.regions) {
    region.id = new_id[region.id];
    for (int& id : region.adjacent) id = new_id[id];
    std::sort(region.adjacent.begin(), region.adjacent.end());
  }
  std::sort(result.regions.begin(), result.regions.end(),
            [](const Region& a, const Region& b) { return a.id < b.id; });
  for (Crossing& crossing : result.crossings) {
    const auto [low, high] = std::minmax({new_id[crossing.region_a], new_id[crossing.region_b]});
    crossing.region_a = low;
    crossing.region_b = high;
  }
  // Stable: the crossings of one pair stay ordered by position.
  std::stable_sort(result.crossings.begin(), result.crossings.end(),
                   [](const Crossing& a, const Crossing& b) {
                     return std::tie(a.region_a, a.region_b) < std::tie(b.region_a, b.region_b);
                   });
  for (std::int32_t& label : result.labels.values()) label = new_id[label];
  return result;
}

}  // namespace

RegionTracker::RegionTracker(const RegionTrackerConfig& config)
    : config_(checked(config)), guard_(std::make_unique<AcceptanceGuard>(config.guard)) {}

RegionTracker::RegionTracker(RegionTracker&&) noexcept = default;
RegionTracker& RegionTracker::operator=(RegionTracker&&) noexcept = default;
RegionTracker::~RegionTracker() = default;

const TrackedRegions& RegionTracker::update(const Decomposition& decomposition) {
  tracked_.stale = !guard_->accept(decomposition);
  if (tracked_.stale) return tracked_;
  const std::vector<int> ids = assign(decomposition.regions);
  noteChanges(decomposition.regions, ids);
  step(decomposition.regions, ids);
  Decomposition fresh = renamed(decomposition, ids);
  tracked_.crossings_changed = !areSame(fresh.crossings, tracked_.decomposition.crossings);
  tracked_.decomposition = std::move(fresh);
  ++tracked_.update;
  return tracked_;
}

RegionTrackerState RegionTracker::state() const {
  RegionTrackerState state;
  for (const auto& [id, track] : tracks_)
    state.tracks.push_back({id, track.missed_updates, track.region.polygon});
  state.next_id = next_id_;
  return state;
}

void RegionTracker::restore(const RegionTrackerState& state) {
  reset();
  for (const RegionTrackerState::Track& saved : state.tracks) {
    Track& track = tracks_[saved.id];
    track.region.id = saved.id;
    track.region.polygon = saved.polygon;
    track.region.area_m2 = area(saved.polygon);
    track.region.centroid = centroid(saved.polygon);
    track.missed_updates = saved.missed_updates;
  }
  next_id_ = state.next_id;
}

void RegionTracker::reset() {
  const std::uint64_t update = tracked_.update;
  *this = RegionTracker(config_);
  // The next update must not look as if it followed the last one.
  tracked_.update = update + 1;
}

bool RegionTracker::mayContinue(const Track& track, const Region& region) const {
  if (!(distance(region.centroid, track.region.centroid) < config_.max_centroid_distance_m))
    return false;
  const double ratio = region.area_m2 / track.region.area_m2;
  return ratio >= config_.min_area_ratio && ratio <= config_.max_area_ratio;
}

// Most regions of a map do not change from update to update: they and their tracks are spared the
// costly intersections with all others.
std::vector<int> RegionTracker::assignUnchanged(const std::vector<Region>& regions) const {
  constexpr double kWhole = 1.0;
  std::vector<int> ids(regions.size(), kNoTrack);
  if (!(kWhole > config_.min_overlap)) return ids;
  std::multimap<std::pair<double, double>, int> starting_at;
  for (const auto& [id, track] : tracks_) {
    const Ring& outer = track.region.polygon.outer;
    if (!outer.empty()) starting_at.emplace(std::pair(outer.front().x, outer.front().y), id);
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const Ring& outer = regions[i].polygon.outer;
    if (outer.empty()) continue;
    const auto range = starting_at.equal_range({outer.front().x, outer.front().y});
    const auto same = std::find_if(range.first, range.second, [&](const auto& item) {
      const Track& track = tracks_.at(item.second);
      return haveSameRings(regions[i], track.region) && mayContinue(track, regions[i]);
    });
    if (same == range.second) continue;
    ids[i] = same->second;
    starting_at.erase(same);
  }
  return ids;
}

std::vector<int> RegionTracker::assign(const std::vector<Region>& regions) {
  std::vector<int> ids = assignUnchanged(regions);
  std::set<int> taken(ids.begin(), ids.end());
  std::vector<std::pair<std::size_t, Bounds2>> open;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (ids[i] == kNoTrack && !regions[i].polygon.outer.empty())
      open.emplace_back(i, bounds(regions[i].polygon));
  }
  std::vector<Candidate> candidates;
  for (const auto& [id, track] : tracks_) {
    if (taken.count(id) > 0 || track.region.polygon.outer.empty()) continue;
    const Bounds2 track_bounds = bounds(track.region.polygon);
    for (const auto& [i, region_bounds] : open) {
      const Region& region = regions[i];
      if (!mayContinue(track, region) || areApart(track_bounds, region_bounds)) continue;
      const double overlap = intersectionOverUnion(region.polygon, track.region.polygon);
      const double distance_m = distance(region.centroid, track.region.centroid);
      if (overlap > config_.min_overlap) candidates.push_back({overlap, distance_m, id, i});
    }
  }
  std::sort(candidates.begin(), candidates.end());
  for (const Candidate& candidate : candidates) {
    if (ids[candidate.region] == kNoTrack && taken.insert(candidate.track).second)
      ids[candidate.region] = candidate.track;
  }
  for (int& id : ids)
    if (id == kNoTrack) id = next_id_++;
  return ids;
}

void RegionTracker::noteChanges(const std::vector<Region>& regions, const std::vector<int>& ids) {
  std::set<int> changed;
  // A track that missed the last update was not there then.
  for (const auto& [id, track] : tracks_)
    if (track.missed_updates == 0) changed.insert(id);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const auto track = tracks_.find(ids[i]);
    const bool is_same = track != tracks_.end() && track->second.missed_updates == 0 &&
                         haveSameRings(regions[i], track->second.region);
    if (is_same) {
      changed.erase(ids[i]);
    } else {
      changed.insert(ids[i]);
    }
  }
  tracked_.changed.assign(changed.begin(), changed.end());
}

void RegionTracker::step(const std::vector<Region>& regions, const std::vector<int>& ids) {
  for (auto& [id, track] : tracks_) ++track.missed_updates;
  for (std::size_t i = 0; i < regions.size(); ++i) tracks_[ids[i]] = {regions[i], 0};
  tracked_.missed.clear();
  for (auto track = tracks_.begin(); track != tracks_.end();) {
    const int missed_updates = track->second.missed_updates;
    if (missed_updates > config_.max_missed_updates) {
      track = tracks_.erase(track);
      continue;
    }
    if (missed_updates > 0) tracked_.missed.push_back(track->first);
    ++track;
  }
}

}  // namespace occusg
