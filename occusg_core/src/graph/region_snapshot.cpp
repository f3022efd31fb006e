// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/region_snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace occusg {
namespace {

bool isUsable(const Region& region) {
  if (region.polygon.outer.size() < 3) return false;
  const double area_m2 = area(region.polygon);
  return std::isfinite(area_m2) && area_m2 > 0.0;
}

bool sameRings(const Polygon& a, const Polygon& b) {
  return a.outer == b.outer && a.holes == b.holes;
}

RegionSnapshot::Support supportFrom(const Region& region) {
  RegionSnapshot::Support support{region, bounds(region.polygon)};
  support.region.area_m2 = area(region.polygon);
  support.region.centroid = centroid(region.polygon);
  return support;
}

RegionPair pairOf(const Crossing& crossing) { return {crossing.region_a, crossing.region_b}; }

bool isBefore(const Crossing& a, const Crossing& b) { return pairOf(a) < pairOf(b); }

bool isSame(const Crossing& a, const Crossing& b) {
  return pairOf(a) == pairOf(b) && a.segment.a == b.segment.a && a.segment.b == b.segment.b;
}

}  // namespace

void RegionSnapshot::update(const TrackedRegions& tracked) {
  changes_.clear();
  changed_regions_.clear();
  changed_contacts_.clear();
  const std::vector<Region>& regions = tracked.decomposition.regions;
  if (!tracked.stale && std::any_of(regions.begin(), regions.end(), isUsable)) {
    adopt(tracked);
    state_ = SnapshotState::kFresh;
  } else if (state_ == SnapshotState::kFresh) {
    state_ = SnapshotState::kStale;
  }
}

void RegionSnapshot::adopt(const TrackedRegions& tracked) {
  ++update_;
  missed_ = {tracked.missed.begin(), tracked.missed.end()};
  // Both are in the order of ids, as a rule: no search needed.
  auto near = regions_.begin();
  std::size_t still_there = 0;
  for (const Region& region : tracked.decomposition.regions) {
    while (near != regions_.end() && near->first < region.id) ++near;
    const bool is_repeated = near != regions_.end() && near->second.update == update_;
    adoptRegion(region, near);
    const bool is_there = near != regions_.end() && near->first == region.id;
    if (is_there && !is_repeated && near->second.update == update_) ++still_there;
  }
  if (still_there != regions_.size()) dropRegionsNotIn(update_);
  std::sort(changed_regions_.begin(), changed_regions_.end());
  const std::vector<Crossing>& crossings = tracked.decomposition.crossings;
  if (!std::equal(crossings.begin(), crossings.end(), crossings_.begin(), crossings_.end(), isSame))
    adoptCrossings(crossings);
}

void RegionSnapshot::adoptRegion(const Region& region, std::map<int, Support>::iterator near) {
  const auto known =
      near != regions_.end() && near->first == region.id ? near : regions_.find(region.id);
  if (known != regions_.end() && sameRings(known->second.region.polygon, region.polygon)) {
    known->second.update = update_;
    return;
  }
  if (!isUsable(region)) {
    // Its track lives, so its room must.
    missed_.insert(region.id);
    return;
  }
  Support support = supportFrom(region);
  support.update = update_;
  changed_regions_.push_back(region.id);
  if (known != regions_.end()) {
    changes_.push_back(known->second.bounds);
    index_.erase(region.id, known->second.bounds);
  }
  changes_.push_back(support.bounds);
  index_.insert(region.id, support.bounds);
  regions_.insert_or_assign(region.id, std::move(support));
}

void RegionSnapshot::dropRegionsNotIn(std::uint64_t update) {
  for (auto item = regions_.begin(); item != regions_.end();) {
    if (item->second.update == update) {
      ++item;
      continue;
    }
    changed_regions_.push_back(item->first);
    changes_.push_back(item->second.bounds);
    index_.erase(item->first, item->second.bounds);
    item = regions_.erase(item);
  }
}

void RegionSnapshot::adoptCrossings(std::vector<Crossing> crossings) {
  std::stable_sort(crossings.begin(), crossings.end(), isBefore);
  auto old = crossings_.cbegin();
  auto fresh = crossings.cbegin();
  while (old != crossings_.cend() || fresh != crossings.cend()) {
    const bool takes_old =
        fresh == crossings.cend() || (old != crossings_.cend() && !isBefore(*fresh, *old));
    const RegionPair regions = pairOf(takes_old ? *old : *fresh);
    const auto isOther = [&](const Crossing& crossing) { return pairOf(crossing) != regions; };
    const auto old_end = std::find_if(old, crossings_.cend(), isOther);
    const auto fresh_end = std::find_if(fresh, crossings.cend(), isOther);
    if (!std::equal(old, old_end, fresh, fresh_end, isSame)) changed_contacts_.push_back(regions);
    old = old_end;
    fresh = fresh_end;
  }
  crossings_ = std::move(crossings);
}

std::vector<Segment2> RegionSnapshot::crossingsBetween(const RegionPair& regions) const {
  const Crossing wanted{regions.first, regions.second, {}};
  const auto range = std::equal_range(crossings_.begin(), crossings_.end(), wanted, isBefore);
  std::vector<Segment2> segments;
  for (auto item = range.first; item != range.second; ++item) segments.push_back(item->segment);
  return segments;
}

std::vector<int> RegionSnapshot::touching(const Bounds2& box) const {
  std::vector<int> ids;
  for (const SpatialIndex::Key key : index_.touching(box)) ids.push_back(static_cast<int>(key));
  return ids;
}

}  // namespace occusg
