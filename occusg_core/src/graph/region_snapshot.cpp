// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/region_snapshot.hpp"

#include <algorithm>
#include <cmath>
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

}  // namespace

void RegionSnapshot::update(const TrackedRegions& tracked) {
  changes_.clear();
  const std::vector<Region>& regions = tracked.decomposition.regions;
  if (!tracked.stale && std::any_of(regions.begin(), regions.end(), isUsable)) {
    adopt(tracked);
    state_ = SnapshotState::kFresh;
  } else if (state_ == SnapshotState::kFresh) {
    state_ = SnapshotState::kStale;
  }
}

void RegionSnapshot::adopt(const TrackedRegions& tracked) {
  crossings_ = tracked.decomposition.crossings;
  missed_ = {tracked.missed.begin(), tracked.missed.end()};
  std::map<int, Support> adopted;
  for (const Region& region : tracked.decomposition.regions) {
    if (!isUsable(region)) {
      // Its track lives, so its room must.
      missed_.insert(region.id);
      continue;
    }
    auto known = regions_.extract(region.id);
    if (!known.empty() && sameRings(known.mapped().region.polygon, region.polygon)) {
      adopted.insert(std::move(known));
      continue;
    }
    if (!known.empty()) changes_.push_back(known.mapped().bounds);
    changes_.push_back(adopted.emplace(region.id, supportFrom(region)).first->second.bounds);
  }
  for (const auto& [id, gone] : regions_) changes_.push_back(gone.bounds);
  regions_ = std::move(adopted);
}

}  // namespace occusg
