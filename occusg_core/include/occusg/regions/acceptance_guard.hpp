// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "occusg/parameter.hpp"
#include "occusg/regions/region.hpp"

namespace occusg {

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
