// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "occusg/regions/region_tracker.hpp"

namespace occusg {

/// Refuses a decomposition that lost too much at once (paper, Sec. 3.3: 15 %). Keeps the totals of
/// the last accepted one; the first is always accepted.
class AcceptanceGuard {
 public:
  /// @throws Error when a parameter is out of range.
  explicit AcceptanceGuard(const AcceptanceGuardConfig& config);

  /// True when `decomposition` may replace the last accepted one, which it then becomes.
  [[nodiscard]] bool accept(const Decomposition& decomposition);
  /// Rejections since the start or the last reset().
  [[nodiscard]] std::size_t rejections() const { return rejections_; }
  void reset();

 private:
  [[nodiscard]] bool losesTooMuch(double area_m2, std::size_t count) const;

  AcceptanceGuardConfig config_;
  double accepted_area_m2_ = 0.0;
  std::size_t accepted_count_ = 0;
  int rejections_in_a_row_ = 0;
  std::size_t rejections_ = 0;
};

}  // namespace occusg
