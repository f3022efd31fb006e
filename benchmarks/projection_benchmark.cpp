// SPDX-License-Identifier: BSD-3-Clause
// Cost of the free-space layer against the size of the map, in generated buildings: the whole
// projection, and the update after each frame of a drive through two unexplored rooms of an
// otherwise known building. The frames are the same for every size. Times are CPU times.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "generated_building.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "thread_clock.hpp"

namespace occusg {
namespace {

const GridFrame kFrame{0.05};
constexpr int kUnexploredRooms = 2;
constexpr double kDrive_m = 5.2;  ///< From the middle of the first room to that of the second.
constexpr int kFrames = 100;

OccupancyMap mapOf(const GeneratedBuilding& building, int unexplored_rooms) {
  OccupancyMapConfig config;
  config.max_memory_mb = 1e6;  // 100 000 m2 take more than a robot would give the map
  OccupancyMap map{config};
  explore(building, unexplored_rooms, map);
  return map;
}

void fullProjection(benchmark::State& state) {
  const GeneratedBuilding building = buildingOf(static_cast<double>(state.range(0)));
  const OccupancyMap map = mapOf(building, 0);
  FreeSpaceLayer layer({}, kFrame);
  for (auto _ : state) {
    layer.reset();
    benchmark::DoNotOptimize(layer.recompute(map));
  }
  state.counters["area_m2"] = building.area();
  state.counters["layer_bytes_per_m2"] = static_cast<double>(layer.memoryBytes()) / building.area();
  state.counters["map_bytes_per_m2"] = static_cast<double>(map.memoryBytes()) / building.area();
}
BENCHMARK(fullProjection)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

/// Each iteration is one frame; only the layer's update counts.
void updateAfterOneFrame(benchmark::State& state) {
  const GeneratedBuilding building = buildingOf(static_cast<double>(state.range(0)));
  OccupancyMap map = mapOf(building, kUnexploredRooms);
  FreeSpaceLayer layer({}, kFrame);
  (void)layer.recompute(map);
  const std::vector<CameraPlace> places =
      drive(building, building.rooms_y - 1, kDrive_m, kDrive_m / kFrames);
  std::vector<double> times_ms;
  double columns = 0.0;
  for (auto _ : state) {
    const RangeImage image = seenIn(building, places[times_ms.size() % places.size()]);
    const MapChange change = map.insert(image);
    const double start_s = threadTime();
    benchmark::DoNotOptimize(layer.update(map, change));
    const double taken_s = threadTime() - start_s;
    state.SetIterationTime(taken_s);
    times_ms.push_back(1e3 * taken_s);
    columns += static_cast<double>(change.columns.size());
  }
  std::sort(times_ms.begin(), times_ms.end());
  state.counters["median_ms"] = times_ms[times_ms.size() / 2];
  state.counters["worst_ms"] = times_ms.back();
  state.counters["changed_columns"] = columns / static_cast<double>(times_ms.size());
}
BENCHMARK(updateAfterOneFrame)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->UseManualTime()
    ->Iterations(kFrames)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace occusg

BENCHMARK_MAIN();
