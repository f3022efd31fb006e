// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/regions/region_tracker.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>

#include "occusg/geometry/polygon_overlap.hpp"
#include "regions/acceptance_guard.hpp"
#include "regions/crossings.hpp"

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

/// By id of a region in its decomposition: the id it gets, ids[i] for the i-th region.
std::vector<std::int32_t> newIds(const std::vector<int>& ids) {
  std::vector<std::int32_t> new_id(ids.size() + 1, kNoRegion);
  std::copy(ids.begin(), ids.end(), new_id.begin() + 1);
  return new_id;
}

/// `decomposition` with region ids replaced, without labels. Polygons of regions that have not
/// changed are taken from `before`, not copied.
Decomposition renamed(const Decomposition& decomposition, const std::vector<std::int32_t>& new_id,
                      const std::vector<int>& changed, std::vector<Region>& before) {
  Decomposition result;
  result.frame = decomposition.frame;
  result.crossings = decomposition.crossings;
  result.regions.reserve(decomposition.regions.size());
  for (const Region& region : decomposition.regions) {
    const int id = new_id[region.id];
    const auto same = std::lower_bound(before.begin(), before.end(), id,
                                       [](const Region& known, int i) { return known.id < i; });
    // A restored tracker knows the track of a region it has not had yet.
    const bool is_known = same != before.end() && same->id == id &&
                          !std::binary_search(changed.begin(), changed.end(), id);
    if (is_known) {
      result.regions.push_back(std::move(*same));
      same->id = id;  // what was moved from stays in order
      result.regions.back().adjacent = region.adjacent;
    } else {
      result.regions.push_back(region);
    }
    Region& renamed = result.regions.back();
    renamed.id = id;
    for (int& beside : renamed.adjacent) beside = new_id[beside];
    std::sort(renamed.adjacent.begin(), renamed.adjacent.end());
  }
  std::sort(result.regions.begin(), result.regions.end(),
            [](const Region& a, const Region& b) { return a.id < b.id; });
  for (Crossing& crossing : result.crossings) {
    const auto [low, high] = std::minmax({new_id[crossing.region_a], new_id[crossing.region_b]});
    crossing.region_a = low;
    crossing.region_b = high;
  }
  sortByRegions(result.crossings);
  return result;
}

/// Replaces every label in the box by newLabel(the source's, the old one).
template <typename NewLabel>
void relabel(const CellBox& box, const Grid<std::int32_t>& source, const NewLabel& newLabel,
             Grid<std::int32_t>& labels) {
  for (int y = box.min.y; y < box.max.y; ++y) {
    const std::int32_t* from = &source.at({box.min.x, y});
    std::int32_t* to = &labels.at({box.min.x, y});
    std::transform(from, from + box.width(), to, to, newLabel);
  }
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
  const std::vector<int> ids = assign(decomposition);
  noteChanges(decomposition, ids);
  step(decomposition.regions, ids);
  const std::vector<std::int32_t> new_id = newIds(ids);
  Grid<std::int32_t> labels = labelsAfter(decomposition, new_id);
  Decomposition fresh =
      renamed(decomposition, new_id, tracked_.changed, tracked_.decomposition.regions);
  fresh.labels = std::move(labels);
  tracked_.crossings_changed = !areSame(fresh.crossings, tracked_.decomposition.crossings);
  tracked_.decomposition = std::move(fresh);
  ++tracked_.update;
  last_update_ = decomposition.update;
  last_ids_ = ids;
  return tracked_;
}

// Only the cells of regions that changed are written, however large the map is.
Grid<std::int32_t> RegionTracker::labelsAfter(const Decomposition& decomposition,
                                              const std::vector<std::int32_t>& new_id) {
  const CellBox& box = decomposition.labels.box();
  Decomposition& before = tracked_.decomposition;
  const bool continues = before.frame.resolution_m == decomposition.frame.resolution_m &&
                         before.labels.box().including(box) == box;
  Grid<std::int32_t> labels = continues ? std::move(before.labels) : Grid<std::int32_t>();
  const bool is_new = labels.empty();
  labels.cover(box, kNoRegion);
  if (is_new) {
    relabel(
        box, decomposition.labels, [&](std::int32_t label, std::int32_t) { return new_id[label]; },
        labels);
    return labels;
  }
  const std::vector<int>& changed = tracked_.changed;
  const auto hasChanged = [&](int id) {
    return std::binary_search(changed.begin(), changed.end(), id);
  };
  for (const Region& region : before.regions) {
    if (!hasChanged(region.id)) continue;
    relabel(
        region.cells.intersected(box), labels,
        [&](std::int32_t label, std::int32_t) { return label == region.id ? kNoRegion : label; },
        labels);
  }
  for (const Region& region : decomposition.regions) {
    const std::int32_t id = new_id[region.id];
    if (!hasChanged(id)) continue;
    relabel(
        region.cells.intersected(box), decomposition.labels,
        [&](std::int32_t label, std::int32_t old) { return label == region.id ? id : old; },
        labels);
  }
  return labels;
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

bool RegionTracker::knowsWhatIsSame(const Decomposition& decomposition) const {
  return decomposition.update != 0 && decomposition.update == last_update_ + 1 &&
         config_.max_centroid_distance_m > 0.0 && config_.min_area_ratio <= 1.0 &&
         config_.max_area_ratio >= 1.0 && config_.min_overlap < 1.0;
}

// Most regions of a map do not change from update to update: they and their tracks are spared the
// costly intersections with all others. What the decomposer knows spares comparing polygons too.
std::vector<int> RegionTracker::assignUnchanged(const Decomposition& decomposition) const {
  constexpr double kWhole = 1.0;
  const std::vector<Region>& regions = decomposition.regions;
  std::vector<int> ids(regions.size(), kNoTrack);
  if (!(kWhole > config_.min_overlap)) return ids;
  if (knowsWhatIsSame(decomposition)) {
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const int id = decomposition.same_as[i];
      if (id != 0) ids[i] = last_ids_[static_cast<std::size_t>(id) - 1];
    }
  }
  std::map<std::pair<double, double>, std::size_t> starting_at;  // regions are disjoint
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const Ring& outer = regions[i].polygon.outer;
    if (ids[i] == kNoTrack && !outer.empty())
      starting_at.emplace(std::pair(outer.front().x, outer.front().y), i);
  }
  if (starting_at.empty()) return ids;
  for (const auto& [id, track] : tracks_) {
    const Ring& outer = track.region.polygon.outer;
    if (outer.empty()) continue;
    const auto start = starting_at.find({outer.front().x, outer.front().y});
    if (start == starting_at.end() || ids[start->second] != kNoTrack) continue;
    const Region& region = regions[start->second];
    if (haveSameRings(region, track.region) && mayContinue(track, region)) ids[start->second] = id;
  }
  return ids;
}

std::vector<int> RegionTracker::assign(const Decomposition& decomposition) {
  const std::vector<Region>& regions = decomposition.regions;
  std::vector<int> ids = assignUnchanged(decomposition);
  std::vector<int> unchanged(ids);
  std::sort(unchanged.begin(), unchanged.end());
  std::vector<std::pair<std::size_t, Bounds2>> open;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (ids[i] == kNoTrack && !regions[i].polygon.outer.empty())
      open.emplace_back(i, bounds(regions[i].polygon));
  }
  std::vector<Candidate> candidates;
  for (const auto& [id, track] : tracks_) {
    const bool is_taken = std::binary_search(unchanged.begin(), unchanged.end(), id);
    if (open.empty() || is_taken || track.region.polygon.outer.empty()) continue;
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
  std::set<int> taken;
  for (const Candidate& candidate : candidates) {
    if (ids[candidate.region] == kNoTrack && taken.insert(candidate.track).second)
      ids[candidate.region] = candidate.track;
  }
  for (int& id : ids)
    if (id == kNoTrack) id = next_id_++;
  return ids;
}

void RegionTracker::noteChanges(const Decomposition& decomposition, const std::vector<int>& ids) {
  const std::vector<Region>& regions = decomposition.regions;
  const bool knows_what_is_same = knowsWhatIsSame(decomposition);
  std::vector<int> same;
  tracked_.changed.clear();
  for (std::size_t i = 0; i < regions.size(); ++i) {
    bool is_same = knows_what_is_same && decomposition.same_as[i] != 0;
    if (!is_same) {
      const auto track = tracks_.find(ids[i]);
      is_same = track != tracks_.end() && track->second.missed_updates == 0 &&
                haveSameRings(regions[i], track->second.region);
    }
    (is_same ? same : tracked_.changed).push_back(ids[i]);
  }
  std::sort(same.begin(), same.end());
  // A track that missed the last update was not there then.
  for (const auto& [id, track] : tracks_) {
    if (track.missed_updates == 0 && !std::binary_search(same.begin(), same.end(), id))
      tracked_.changed.push_back(id);
  }
  std::sort(tracked_.changed.begin(), tracked_.changed.end());
  tracked_.changed.erase(std::unique(tracked_.changed.begin(), tracked_.changed.end()),
                         tracked_.changed.end());
}

void RegionTracker::step(const std::vector<Region>& regions, const std::vector<int>& ids) {
  for (auto& [id, track] : tracks_) ++track.missed_updates;
  const std::vector<int>& changed = tracked_.changed;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    Track& track = tracks_[ids[i]];
    track.missed_updates = 0;
    if (std::binary_search(changed.begin(), changed.end(), ids[i])) {
      track.region = regions[i];
    } else {
      // A restored track has them from its polygon, which rounds otherwise.
      track.region.area_m2 = regions[i].area_m2;
      track.region.centroid = regions[i].centroid;
    }
  }
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
