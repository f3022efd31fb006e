// SPDX-License-Identifier: BSD-3-Clause
#include "graph/region_snapshot.hpp"

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

bool hasUsable(const std::vector<Region>& regions) {
  return std::any_of(regions.begin(), regions.end(),
                     [](const Region& region) { return isUsable(region); });
}

}  // namespace

void RegionSnapshot::update(const TrackedRegions& tracked) {
  changes_.clear();
  changed_regions_.clear();
  changed_contacts_.clear();
  const std::vector<Region>& regions = tracked.decomposition.regions;
  if (!tracked.stale && hasUsable(regions)) {
    const bool follows = update_ > 0 && tracked.update == update_ + 1;
    const bool is_known = update_ > 0 && tracked.update == update_;
    if (follows) {
      adoptChanged(tracked);
    } else if (!is_known) {
      adoptAll(tracked);
    }
    update_ = tracked.update;
    std::sort(changed_regions_.begin(), changed_regions_.end());
    state_ = SnapshotState::kFresh;
  } else if (state_ == SnapshotState::kFresh) {
    state_ = SnapshotState::kStale;
  }
}

void RegionSnapshot::adoptAll(const TrackedRegions& tracked) {
  std::set<int> there;
  for (const Region& region : tracked.decomposition.regions) {
    adoptRegion(region);
    there.insert(region.id);
  }
  std::vector<int> gone;
  for (const auto& [id, support] : regions_)
    if (there.count(id) == 0) gone.push_back(id);
  for (const int region : gone) dropRegion(region);
  noteMissed(tracked.missed);
  adoptCrossings(tracked.decomposition.crossings);
}

void RegionSnapshot::adoptChanged(const TrackedRegions& tracked) {
  const std::vector<Region>& regions = tracked.decomposition.regions;
  for (const int id : tracked.changed) {
    const auto region =
        std::lower_bound(regions.begin(), regions.end(), id,
                         [](const Region& known, int wanted) { return known.id < wanted; });
    if (region != regions.end() && region->id == id) {
      adoptRegion(*region);
    } else {
      dropRegion(id);
    }
  }
  noteMissed(tracked.missed);
  if (tracked.crossings_changed) adoptCrossings(tracked.decomposition.crossings);
}

void RegionSnapshot::adoptRegion(const Region& region) {
  const auto known = regions_.find(region.id);
  if (known != regions_.end() && sameRings(known->second.region.polygon, region.polygon)) return;
  if (!isUsable(region)) {
    dropRegion(region.id);
    unusable_.insert(region.id);
    return;
  }
  unusable_.erase(region.id);
  Support support = supportFrom(region);
  if (known != regions_.end()) {
    changes_.push_back(known->second.bounds);
    index_.erase(region.id, known->second.bounds);
  }
  changed_regions_.push_back(region.id);
  changes_.push_back(support.bounds);
  index_.insert(region.id, support.bounds);
  regions_.insert_or_assign(region.id, std::move(support));
}

void RegionSnapshot::dropRegion(int region) {
  unusable_.erase(region);
  const auto known = regions_.find(region);
  if (known == regions_.end()) return;
  changed_regions_.push_back(region);
  changes_.push_back(known->second.bounds);
  index_.erase(region, known->second.bounds);
  regions_.erase(known);
}

void RegionSnapshot::noteMissed(const std::vector<int>& missed) {
  missed_ = {missed.begin(), missed.end()};
  missed_.insert(unusable_.begin(), unusable_.end());
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
