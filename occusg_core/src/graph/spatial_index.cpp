// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/graph/spatial_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace occusg {
namespace {

// About a room's width: few buckets a query, few entries a bucket.
constexpr double kBucket_m = 2.0;
// Keeps a box the size of a city from being listed in a million buckets.
constexpr std::int64_t kMostBucketsOfBox = 256;
// Far beyond any map; there all places share the outermost buckets.
constexpr double kLastBucket = 1073741824.0;

struct BucketBox {
  std::int64_t min_x = 0, min_y = 0, max_x = 0, max_y = 0;  ///< Inclusive.

  [[nodiscard]] std::int64_t count() const {
    const std::int64_t width = max_x - min_x + 1;
    const std::int64_t height = max_y - min_y + 1;
    // Both sides are below 2^31 + 2, so the product fits.
    return width * height;
  }
};

std::int64_t bucketAt(double coordinate_m) {
  if (std::isnan(coordinate_m)) return 0;
  return static_cast<std::int64_t>(
      std::clamp(std::floor(coordinate_m / kBucket_m), -kLastBucket, kLastBucket));
}

BucketBox bucketsOf(const Bounds2& box) {
  return {bucketAt(box.min.x), bucketAt(box.min.y), bucketAt(box.max.x), bucketAt(box.max.y)};
}

std::uint64_t keyOf(std::int64_t x, std::int64_t y) {
  constexpr std::uint64_t kLow = 0xFFFFFFFFU;
  return (static_cast<std::uint64_t>(x) & kLow) << 32U | (static_cast<std::uint64_t>(y) & kLow);
}

bool touch(const Bounds2& a, const Bounds2& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

double distanceTo(const Bounds2& box, const Point2& point) {
  const double dx = std::max({box.min.x - point.x, 0.0, point.x - box.max.x});
  const double dy = std::max({box.min.y - point.y, 0.0, point.y - box.max.y});
  return std::hypot(dx, dy);
}

}  // namespace

void SpatialIndex::insert(Key key, const Bounds2& bounds) {
  ++size_;
  const BucketBox box = bucketsOf(bounds);
  if (box.count() > kMostBucketsOfBox) {
    large_.push_back({key, bounds});
    return;
  }
  for (std::int64_t y = box.min_y; y <= box.max_y; ++y) {
    for (std::int64_t x = box.min_x; x <= box.max_x; ++x)
      buckets_[keyOf(x, y)].push_back({key, bounds});
  }
}

void SpatialIndex::erase(Key key, const Bounds2& bounds) {
  bool found = false;
  const auto eraseFrom = [&](Bucket& bucket) {
    const auto entry = std::find_if(bucket.begin(), bucket.end(),
                                    [&](const Entry& candidate) { return candidate.key == key; });
    if (entry == bucket.end()) return;
    found = true;
    *entry = bucket.back();
    bucket.pop_back();
  };
  const BucketBox box = bucketsOf(bounds);
  if (box.count() > kMostBucketsOfBox) {
    eraseFrom(large_);
  } else {
    for (std::int64_t y = box.min_y; y <= box.max_y; ++y) {
      for (std::int64_t x = box.min_x; x <= box.max_x; ++x) {
        const auto bucket = buckets_.find(keyOf(x, y));
        if (bucket == buckets_.end()) continue;
        eraseFrom(bucket->second);
        if (bucket->second.empty()) buckets_.erase(bucket);
      }
    }
  }
  if (found) --size_;
}

template <typename Visit>
void SpatialIndex::visitBuckets(const Bounds2& box, const Visit& visit) const {
  visit(large_);
  const BucketBox wanted = bucketsOf(box);
  if (wanted.count() > static_cast<std::int64_t>(buckets_.size())) {
    for (const auto& [key, bucket] : buckets_) visit(bucket);
    return;
  }
  for (std::int64_t y = wanted.min_y; y <= wanted.max_y; ++y) {
    for (std::int64_t x = wanted.min_x; x <= wanted.max_x; ++x) {
      const auto bucket = buckets_.find(keyOf(x, y));
      if (bucket != buckets_.end()) visit(bucket->second);
    }
  }
}

std::vector<SpatialIndex::Key> SpatialIndex::touching(const Bounds2& box) const {
  std::vector<Key> keys;
  visitBuckets(box, [&](const Bucket& bucket) {
    for (const Entry& entry : bucket)
      if (touch(entry.bounds, box)) keys.push_back(entry.key);
  });
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return keys;
}

// Looks in squares around the point that double in size: the nearest is found once a square reaches
// farther than the best in it.
std::optional<SpatialIndex::Key> SpatialIndex::nearest(
    const Point2& point, double max_distance_m, const std::function<bool(Key)>& accept) const {
  if (std::isnan(point.x) || std::isnan(point.y)) return std::nullopt;
  std::optional<std::pair<double, Key>> best;
  for (double reach_m = kBucket_m;; reach_m *= 2.0) {
    const double within_m = std::min(reach_m, max_distance_m);
    const Bounds2 square{{point.x - within_m, point.y - within_m},
                         {point.x + within_m, point.y + within_m}};
    const bool sees_all = within_m == max_distance_m ||
                          bucketsOf(square).count() > static_cast<std::int64_t>(buckets_.size());
    visitBuckets(square, [&](const Bucket& bucket) {
      for (const Entry& entry : bucket) {
        const double distance_m = distanceTo(entry.bounds, point);
        if (distance_m > (sees_all ? max_distance_m : within_m)) continue;
        const std::pair<double, Key> candidate{distance_m, entry.key};
        if ((!best || candidate < *best) && accept(entry.key)) best = candidate;
      }
    });
    if (best || sees_all) break;
  }
  if (!best) return std::nullopt;
  return best->second;
}

}  // namespace occusg
