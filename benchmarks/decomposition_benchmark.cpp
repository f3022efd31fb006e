// SPDX-License-Identifier: BSD-3-Clause
// Cost of the dual-space decomposition: over the maps of OCCUSG_MAPS2D_DIR, and over generated
// floors against their size. Each room of a generated floor has a pillar and doors to all its
// neighbours.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "occusg/regions/dude_decomposer.hpp"

#ifndef OCCUSG_MAPS2D_DIR
#define OCCUSG_MAPS2D_DIR ""
#endif

namespace occusg {
namespace {

constexpr double kResolution_m = 0.1;
constexpr double kMapResolution_m = 0.05;
constexpr int kBrightestObstacle = 250;
constexpr int kPitch_cells = 32;  ///< A room of 3 m and its walls.
constexpr int kWall_cells = 2;
constexpr Cell kPillar{20, 20};
constexpr int kPillar_cells = 4;
constexpr int kDoorAt_cells = 8;
constexpr int kDoor_cells = 9;

void set(FreeSpace& layer, const CellBox& box, std::int8_t value) {
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) layer.cells.at({x, y}) = value;
}

CellBox rectangle(int x, int y, int width, int height) { return {{x, y}, {x + width, y + height}}; }

/// `rooms` rooms in rows of equal length.
FreeSpace generatedFloor(int rooms) {
  const int across = static_cast<int>(std::ceil(std::sqrt(rooms)));
  const int rows = (rooms + across - 1) / across;
  const CellBox box{{0, 0},
                    {across * kPitch_cells + kWall_cells, rows * kPitch_cells + kWall_cells}};
  FreeSpace layer{GridFrame{kResolution_m}, FreeSpaceCells(box, kFullObstacle), box};
  const int size = kPitch_cells - kWall_cells;
  for (int room = 0; room < rooms; ++room) {
    const int x = room % across * kPitch_cells + kWall_cells;
    const int y = room / across * kPitch_cells + kWall_cells;
    set(layer, rectangle(x, y, size, size), kFree);
    set(layer, rectangle(x + kPillar.x, y + kPillar.y, kPillar_cells, kPillar_cells),
        kFullObstacle);
    if (room % across > 0)
      set(layer, rectangle(x - kWall_cells, y + kDoorAt_cells, kWall_cells, kDoor_cells), kFree);
    if (room >= across)
      set(layer, rectangle(x + kDoorAt_cells, y - kWall_cells, kDoor_cells, kWall_cells), kFree);
  }
  return layer;
}

/// Pillars stay holes, so that the number of holes is that of the rooms.
DudeDecomposerConfig withPillars() {
  DudeDecomposerConfig config;
  config.depth_threshold_m = 1.5;
  config.max_ignored_hole_m = 0.0;
  return config;
}

void report(benchmark::State& state, const DudeDecomposer& decomposer, std::size_t regions) {
  const auto updates = static_cast<double>(std::max<std::size_t>(1, decomposer.counters().updates));
  state.counters["corners"] = static_cast<double>(decomposer.counters().corners) / updates;
  state.counters["regions"] = static_cast<double>(regions);
}

void batchOfRooms(benchmark::State& state) {
  const FreeSpace layer = generatedFloor(static_cast<int>(state.range(0)));
  DudeDecomposer decomposer(withPillars());
  std::size_t regions = 0;
  for (auto _ : state) {
    decomposer.reset();
    regions = decomposer.update(layer).regions.size();
  }
  report(state, decomposer, regions);
}
// 100 rooms: 2 000 corners and 100 holes; 1 000 rooms: 20 000 corners.
BENCHMARK(batchOfRooms)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

/// A floor on which a box in a door comes and goes, so that the two rooms beside it are divided
/// again and again.
class BusyDoor {
 public:
  explicit BusyDoor(int rooms) : layer_(generatedFloor(rooms)), decomposer_(withPillars()) {
    (void)decomposer_.update(layer_);
    const int across = static_cast<int>(std::ceil(std::sqrt(rooms)));
    const int rows = (rooms + across - 1) / across;
    const int x = across / 2 * kPitch_cells + kWall_cells;
    const int y = rows / 2 * kPitch_cells + kWall_cells;
    layer_.changed = rectangle(x - kWall_cells, y + kDoorAt_cells, kWall_cells, 3);
  }

  std::size_t update() {
    is_blocked_ = !is_blocked_;
    set(layer_, layer_.changed, is_blocked_ ? kFullObstacle : kFree);
    return decomposer_.update(layer_).regions.size();
  }

  [[nodiscard]] const DudeDecomposer& decomposer() const { return decomposer_; }

 private:
  FreeSpace layer_;
  DudeDecomposer decomposer_;
  bool is_blocked_ = false;
};

void incrementalInRooms(benchmark::State& state) {
  BusyDoor door(static_cast<int>(state.range(0)));
  std::size_t regions = 0;
  const std::size_t batches = door.decomposer().counters().batch_updates;
  for (auto _ : state) regions = door.update();
  if (door.decomposer().counters().batch_updates != batches) state.SkipWithError("not incremental");
  report(state, door.decomposer(), regions);
}
BENCHMARK(incrementalInRooms)
    ->Arg(10)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond);

/// Resident memory of the process [KiB].
double residentMemory() {
  std::ifstream statm("/proc/self/statm");
  double total_pages = 0.0;
  double resident_pages = 0.0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024.0;
}

/// How much the process grows over 100 000 updates, after the first thousand.
void memoryOverUpdates(benchmark::State& state) {
  BusyDoor door(16);
  for (int i = 0; i < 1000; ++i) (void)door.update();
  const double before = residentMemory();
  for (auto _ : state) (void)door.update();
  state.counters["growth_kib"] = residentMemory() - before;
}
BENCHMARK(memoryOverUpdates)->Iterations(100000)->Repetitions(1)->Unit(benchmark::kMillisecond);

FreeSpace mapOf(const std::string& path) {
  const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  const CellBox box{{0, 0}, {image.cols, image.rows}};
  FreeSpace layer{GridFrame{kMapResolution_m}, FreeSpaceCells(box, kFullObstacle), box};
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x)
      if (image.at<std::uint8_t>(image.rows - 1 - y, x) > kBrightestObstacle)
        layer.cells.at({x, y}) = kFree;
  return layer;
}

void batchOfMap(benchmark::State& state, const std::string& path) {
  const FreeSpace layer = mapOf(path);
  DudeDecomposer decomposer({});
  std::size_t regions = 0;
  for (auto _ : state) {
    decomposer.reset();
    regions = decomposer.update(layer).regions.size();
  }
  report(state, decomposer, regions);
}

void registerMaps(const std::string& folder) {
  if (folder.empty() || !std::filesystem::is_directory(folder)) {
    std::cerr << "OCCUSG_MAPS2D_DIR is no folder: benchmarks over real maps are left out\n";
    return;
  }
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_annotation = name.find("_gt_") != std::string::npos;
    if (entry.path().extension() == ".png" && !is_annotation)
      paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths)
    benchmark::RegisterBenchmark(
        ("batchOfMap/" + std::filesystem::path(path).stem().string()).c_str(),
        [path](benchmark::State& state) { batchOfMap(state, path); })
        ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace occusg

int main(int argc, char** argv) {
  occusg::registerMaps(OCCUSG_MAPS2D_DIR);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
