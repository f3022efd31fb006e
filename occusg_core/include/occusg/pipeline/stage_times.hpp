// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace occusg {

/// The stages of the pipeline in the order data passes them, and their sum.
enum class Stage { kPointCloud, kOccupancy, kFreeSpace, kDecomposition, kTracking, kGraph, kTotal };

inline constexpr std::array<Stage, 7> kStages = {
    Stage::kPointCloud, Stage::kOccupancy, Stage::kFreeSpace, Stage::kDecomposition,
    Stage::kTracking,   Stage::kGraph,     Stage::kTotal};

/// "point_cloud", "occupancy", ...: the keys of timing.json.
[[nodiscard]] std::string nameOf(Stage stage);

/// Statistics of one stage's durations; all zero when it never ran.
struct StageSummary {
  std::size_t count = 0;
  double mean_ms = 0.0;
  double std_ms = 0.0;  ///< Of the population.
  double p50_ms = 0.0;  ///< Nearest rank.
  double p95_ms = 0.0;  ///< Nearest rank.
  double max_ms = 0.0;
};

[[nodiscard]] StageSummary summarize(std::vector<double> durations_ms);

/// Durations of a stage that are kept, so that a pipeline that runs for days does not grow: the
/// newest half of these at least.
inline constexpr std::size_t kMaxKeptDurations = 20'000;

/// How long each stage took, and how much memory its result holds.
class StageTimes {
 public:
  void add(Stage stage, double duration_ms);
  void setMemory(Stage stage, std::size_t bytes);
  /// Adds all durations and memory of `other`.
  void merge(const StageTimes& other);
  [[nodiscard]] StageSummary summary(Stage stage) const;
  [[nodiscard]] std::size_t memoryBytes(Stage stage) const;

 private:
  std::array<std::vector<double>, kStages.size()> durations_ms_;
  std::array<std::size_t, kStages.size()> memory_bytes_{};
};

/// Runs `work` and books how long it took. Durations are measured, not used: no result of the
/// pipeline depends on them.
template <typename Work>
decltype(auto) timed(StageTimes& times, Stage stage, Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  decltype(auto) result = std::forward<Work>(work)();
  const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
  times.add(stage, elapsed.count());
  return result;
}

}  // namespace occusg
