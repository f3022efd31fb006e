// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "occusg/geometry/polygon.hpp"

namespace occusg {

/// Boxes and points in the ground plane, found by place: a lattice of square buckets, so that a
/// query costs what is near it and not what there is. Answers do not depend on the order of
/// insertion.
class SpatialIndex {
 public:
  /// What is indexed: an id of the caller.
  using Key = std::int64_t;

  /// Adds `key` at `bounds`, which must be finite; a point is a box without extent.
  void insert(Key key, const Bounds2& bounds);
  /// Takes away what `insert` of the same key and bounds added.
  void erase(Key key, const Bounds2& bounds);

  /// Keys of the boxes that touch `box`, sorted.
  [[nodiscard]] std::vector<Key> touching(const Bounds2& box) const;

  /// The accepted key nearest to `point`, at most `max_distance_m` away; the smaller of two equally
  /// near.
  [[nodiscard]] std::optional<Key> nearest(const Point2& point, double max_distance_m,
                                           const std::function<bool(Key)>& accept) const;

  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  struct Entry {
    Key key = 0;
    Bounds2 bounds;
  };
  using Bucket = std::vector<Entry>;

  template <typename Visit>
  void visitBuckets(const Bounds2& box, const Visit& visit) const;

  std::unordered_map<std::uint64_t, Bucket> buckets_;
  Bucket large_;  ///< Boxes over too many buckets to be listed in each.
  std::size_t size_ = 0;
};

}  // namespace occusg
