// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/score_estimates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr std::uint64_t kSeed = 20240229;
constexpr double kTail = 0.025;

using Values = std::vector<std::optional<double>>;
using Sample = std::vector<std::size_t>;  ///< Indices of scenes, with repetition.

constexpr std::array<Estimate ThresholdEstimates::*, 6> kThresholdEstimates{
    &ThresholdEstimates::recall,      &ThresholdEstimates::precision,
    &ThresholdEstimates::f1,          &ThresholdEstimates::mean_iou,
    &ThresholdEstimates::mean_iou_gt, &ThresholdEstimates::boundary_f1};

std::optional<double> ratioOrNone(double a, double b) {
  return b > 0.0 ? std::optional<double>(a / b) : std::nullopt;
}

/// Order: for each threshold as `kThresholdEstimates`, then over- and under-segmentation.
Values valuesOf(const RoomMetrics& scene) {
  Values values;
  for (const ThresholdMetrics& at : scene.at) {
    values.insert(values.end(),
                  {at.recall, at.precision, at.f1, at.mean_iou, at.mean_iou_gt, at.boundary_f1});
  }
  values.insert(values.end(), {scene.over_segmentation, scene.under_segmentation});
  return values;
}

Values macroValues(const std::vector<Values>& scenes, const Sample& sample) {
  Values means(scenes.front().size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    double sum = 0.0;
    double defined = 0.0;
    for (const std::size_t scene : sample) {
      if (!scenes[scene][i]) continue;
      sum += *scenes[scene][i];
      defined += 1.0;
    }
    means[i] = ratioOrNone(sum, defined);
  }
  return means;
}

/// Rooms and matches of all scenes of a sample together.
struct PooledCounts {
  double n_truth = 0.0;
  double n_predicted = 0.0;
  double matches = 0.0;
  double iou = 0.0;
  double boundary_f1 = 0.0;
};

void appendPooled(const PooledCounts& pool, Values& values) {
  const auto recall = ratioOrNone(pool.matches, pool.n_truth);
  const auto f1 = ratioOrNone(2.0 * pool.matches, pool.n_truth + pool.n_predicted);
  values.insert(values.end(),
                {recall.value_or(0.0), ratioOrNone(pool.matches, pool.n_predicted).value_or(0.0),
                 f1.value_or(0.0), ratioOrNone(pool.iou, pool.matches),
                 ratioOrNone(pool.iou, pool.n_truth).value_or(0.0),
                 ratioOrNone(pool.boundary_f1, pool.matches).value_or(0.0)});
}

Values microValues(const std::vector<RoomMetrics>& scenes, const Sample& sample) {
  Values values;
  for (std::size_t i = 0; i < scenes.front().at.size(); ++i) {
    PooledCounts pool;
    for (const std::size_t index : sample) {
      const RoomMetrics& scene = scenes[index];
      const ThresholdMetrics& at = scene.at[i];
      pool.n_truth += static_cast<double>(scene.n_truth);
      pool.n_predicted += static_cast<double>(scene.n_predicted);
      pool.matches += at.matches;
      pool.iou += at.mean_iou.value_or(0.0) * at.matches;
      pool.boundary_f1 += at.boundary_f1 * at.matches;
    }
    appendPooled(pool, values);
  }
  double n_truth = 0.0, n_predicted = 0.0, split = 0.0, merging = 0.0;
  for (const std::size_t index : sample) {
    const RoomMetrics& scene = scenes[index];
    n_truth += static_cast<double>(scene.n_truth);
    n_predicted += static_cast<double>(scene.n_predicted);
    split += scene.over_segmentation * static_cast<double>(scene.n_truth);
    merging += scene.under_segmentation * static_cast<double>(scene.n_predicted);
  }
  values.push_back(ratioOrNone(split, n_truth).value_or(0.0));
  values.push_back(ratioOrNone(merging, n_predicted).value_or(0.0));
  return values;
}

/// Percentile interval of the defined ones of `draws`.
std::optional<Interval> percentileInterval(std::vector<double> draws) {
  if (draws.empty()) return std::nullopt;
  std::sort(draws.begin(), draws.end());
  const double last = static_cast<double>(draws.size() - 1);
  const auto at = [&](double share) {
    return draws[static_cast<std::size_t>(std::lround(share * last))];
  };
  return Interval{at(kTail), at(1.0 - kTail)};
}

/// The values of all `n` scenes once, with intervals from resampling them.
template <typename ValuesOfSample>
std::vector<Estimate> bootstrapped(std::size_t n, const ValuesOfSample& valuesOfSample) {
  Sample sample(n);
  for (std::size_t i = 0; i < n; ++i) sample[i] = i;
  const Values whole = valuesOfSample(sample);
  std::vector<Estimate> estimates(whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) estimates[i].value = whole[i];
  if (n < 2) return estimates;
  std::vector<std::vector<double>> draws(whole.size());
  std::mt19937_64 generator(kSeed);
  for (int draw = 0; draw < kBootstrapSamples; ++draw) {
    for (std::size_t& index : sample) index = static_cast<std::size_t>(generator() % n);
    const Values values = valuesOfSample(sample);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i]) draws[i].push_back(*values[i]);
  }
  for (std::size_t i = 0; i < whole.size(); ++i)
    estimates[i].confidence_95 = percentileInterval(std::move(draws[i]));
  return estimates;
}

}  // namespace

ScoreEstimates estimate(const std::vector<RoomMetrics>& scenes, Averaging averaging) {
  if (scenes.empty()) return {};
  std::vector<Values> values;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    requireSameThresholds(scenes[i], scenes.front(), i);
    values.push_back(valuesOf(scenes[i]));
  }
  const auto flat = bootstrapped(scenes.size(), [&](const Sample& sample) {
    return averaging == Averaging::kMacro ? macroValues(values, sample)
                                          : microValues(scenes, sample);
  });
  ScoreEstimates estimates;
  std::size_t next = 0;
  for (const ThresholdMetrics& at : scenes.front().at) {
    ThresholdEstimates of_threshold;
    of_threshold.threshold = at.threshold;
    for (const auto member : kThresholdEstimates) of_threshold.*member = flat[next++];
    estimates.at.push_back(of_threshold);
  }
  estimates.over_segmentation = flat[next++];
  estimates.under_segmentation = flat[next];
  return estimates;
}

Estimate pairedDifference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) {
    throw refuse("paired scores", std::to_string(a.size()) + " against " + std::to_string(b.size()),
                 "one of each a scene is needed");
  }
  if (a.empty()) return {};
  return bootstrapped(a.size(),
                      [&](const Sample& sample) {
                        double sum = 0.0;
                        for (const std::size_t i : sample) sum += b[i] - a[i];
                        return Values{sum / static_cast<double>(sample.size())};
                      })
      .front();
}

}  // namespace occusg
