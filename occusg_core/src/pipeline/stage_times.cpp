// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/stage_times.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace occusg {
namespace {

std::size_t indexOf(Stage stage) { return static_cast<std::size_t>(stage); }

double nearestRank(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

std::string nameOf(Stage stage) {
  switch (stage) {
    case Stage::kPointCloud:
      return "point_cloud";
    case Stage::kOccupancy:
      return "occupancy";
    case Stage::kFreeSpace:
      return "free_space";
    case Stage::kDecomposition:
      return "decomposition";
    case Stage::kTracking:
      return "tracking";
    case Stage::kGraph:
      return "graph";
    case Stage::kTotal:
      return "total";
  }
  return "unknown";
}

StageSummary summarize(std::vector<double> durations_ms) {
  if (durations_ms.empty()) return {};
  std::sort(durations_ms.begin(), durations_ms.end());
  const auto count = static_cast<double>(durations_ms.size());
  const double mean = std::accumulate(durations_ms.begin(), durations_ms.end(), 0.0) / count;
  const double squares =
      std::accumulate(durations_ms.begin(), durations_ms.end(), 0.0,
                      [&](double sum, double ms) { return sum + (ms - mean) * (ms - mean); });
  return {durations_ms.size(),
          mean,
          std::sqrt(squares / count),
          nearestRank(durations_ms, 0.50),
          nearestRank(durations_ms, 0.95),
          durations_ms.back()};
}

void StageTimes::add(Stage stage, double duration_ms) {
  std::vector<double>& durations_ms = durations_ms_[indexOf(stage)];
  if (durations_ms.size() >= kMaxKeptDurations) {
    durations_ms.erase(durations_ms.begin(),
                       durations_ms.begin() + static_cast<std::ptrdiff_t>(kMaxKeptDurations / 2));
  }
  durations_ms.push_back(duration_ms);
}

void StageTimes::setMemory(Stage stage, std::size_t bytes) {
  memory_bytes_[indexOf(stage)] = bytes;
}

void StageTimes::merge(const StageTimes& other) {
  for (const Stage stage : kStages) {
    for (const double duration_ms : other.durations_ms_[indexOf(stage)]) add(stage, duration_ms);
    memory_bytes_[indexOf(stage)] += other.memory_bytes_[indexOf(stage)];
  }
}

StageSummary StageTimes::summary(Stage stage) const {
  return summarize(durations_ms_[indexOf(stage)]);
}

std::size_t StageTimes::memoryBytes(Stage stage) const { return memory_bytes_[indexOf(stage)]; }

}  // namespace occusg
