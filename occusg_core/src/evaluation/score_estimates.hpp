// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "occusg/evaluation/room_metrics.hpp"

namespace occusg {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// A mean over scenes, and where it may lie for other scenes of the kind.
struct Estimate {
  std::optional<double> value;            ///< Undefined when no scene defines it.
  std::optional<Interval> confidence_95;  ///< Undefined for less than two scenes.
};

/// Detection scores at one IoU threshold.
struct ThresholdEstimates {
  double threshold = 0.0;
  Estimate recall;
  Estimate precision;
  Estimate f1;
  Estimate mean_iou;
  Estimate mean_iou_gt;
  Estimate boundary_f1;
};

struct ScoreEstimates {
  std::vector<ThresholdEstimates> at;
  Estimate over_segmentation;
  Estimate under_segmentation;
};

/// How scenes are averaged.
enum class Averaging {
  kMacro,  ///< Every scene counts the same (the paper's tables); undefined values are left out.
  kMicro,  ///< Every room counts the same: matches and rooms of all scenes are pooled.
};

inline constexpr int kBootstrapSamples = 2000;

/// Means with 95 % confidence intervals from the percentile bootstrap over scenes (Efron 1979):
/// `kBootstrapSamples` times as many scenes are drawn with replacement, by a generator of fixed
/// seed, so equal scenes give equal intervals.
/// @throws Error when the scenes differ in their thresholds.
[[nodiscard]] ScoreEstimates estimate(const std::vector<RoomMetrics>& scenes, Averaging averaging);

/// Mean of `b` - `a` over scenes evaluated under both of two configurations, with its interval from
/// the same bootstrap over pairs: when it holds no zero, the difference is not chance.
/// @pre a.size() == b.size()
[[nodiscard]] Estimate pairedDifference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace occusg
