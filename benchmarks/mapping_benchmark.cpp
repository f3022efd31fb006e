// SPDX-License-Identifier: BSD-3-Clause
// Cost of a frame's way into the occupancy map, beside OctoMap's own two ways: over the project's
// recording, over those of OCCUSG_RGBD_DIR and over a generated building with long views. All ways
// take the same frames in turn within one run, so that each is measured in the same state of the
// machine, and enough of them at a time that each has its own map in the cache, as a robot that
// builds one map has. Ours take every frame five times, into five maps, and the middle time
// counts, so that what else the machine does at that moment does not make a frame a slow one;
// OctoMap's, which would take minutes, take it once. Compare only figures of one run.
#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "deep_building.hpp"
#include "map_difference.hpp"
#include "occusg/io/sequence_reader.hpp"
#include "occusg/perception/depth_projector.hpp"

#ifndef OCCUSG_RGBD_DIR
#define OCCUSG_RGBD_DIR ""
#endif

namespace occusg {
namespace {

constexpr int kStride = 2;
constexpr std::size_t kTurn_frames = 125;
constexpr std::size_t kDeepFrames = 80;
constexpr std::size_t kMostFrames = 250;
constexpr std::size_t kAttempts = 5;

using FrameSource = std::function<DepthFrame(std::size_t)>;

double cpuMs() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double wallMs() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

/// One way of getting frames into a map, and what each frame took, by attempt.
struct Way {
  using Insert = std::function<void(const RangeImage&)>;
  using Times = std::vector<std::vector<double>>;

  std::string name;
  Times cpu_ms = {};
  Times wall_ms = {};

  void take(const RangeImage& image, std::size_t attempt, const Insert& insert) {
    cpu_ms.resize(std::max(cpu_ms.size(), attempt + 1));
    wall_ms.resize(cpu_ms.size());
    const double cpu = cpuMs();
    const double wall = wallMs();
    insert(image);
    cpu_ms[attempt].push_back(cpuMs() - cpu);
    wall_ms[attempt].push_back(wallMs() - wall);
  }
};

/// Of each frame the middle one of its attempts.
std::vector<double> middleTimes(const Way::Times& times) {
  std::vector<double> middle;
  for (std::size_t frame = 0; frame < times.front().size(); ++frame) {
    std::vector<double> attempts;
    for (const std::vector<double>& attempt : times) attempts.push_back(attempt[frame]);
    middle.push_back(quantile(attempts, 0.5));
  }
  return middle;
}

OccupancyMap mapWith(IntegrationMode mode, int threads) {
  OccupancyMapConfig config;
  config.mode = mode;
  config.threads = threads;
  return OccupancyMap(config);
}

enum class Discretize { kNo, kYes };

/// The conversion of the cloud is not part of what is measured.
class OctomapWay {
 public:
  explicit OctomapWay(Discretize discretize)
      : discretize_(discretize), tree_(testing::emptyTreeLike(OccupancyMapConfig{})) {}

  void take(const RangeImage& image, Way& way) {
    const octomap::Pointcloud cloud = testing::toOctomapCloud(toPointCloud(image));
    const octomap::point3d origin(image.origin.x, image.origin.y, image.origin.z);
    way.take(image, 0, [&](const RangeImage&) {
      tree_.insertPointCloud(cloud, origin, OccupancyMapConfig{}.max_range_m, false,
                             discretize_ == Discretize::kYes);
    });
  }

 private:
  Discretize discretize_;
  octomap::OcTree tree_;
};

/// One of ours, with a map for every attempt.
struct MapWay {
  MapWay(const std::string& name, IntegrationMode mode, int threads) : way{name} {
    for (std::size_t i = 0; i < kAttempts; ++i) maps.push_back(mapWith(mode, threads));
  }

  void take(const std::vector<RangeImage>& images, std::size_t attempt) {
    for (const RangeImage& image : images) {
      way.take(image, attempt, [&](const RangeImage& frame) { (void)maps[attempt].insert(frame); });
    }
  }

  Way way;
  std::vector<OccupancyMap> maps;
};

/// @param reference_ms median of what the ratio is to.
void report(benchmark::State& state, const Way& way, double reference_ms) {
  const std::vector<double> cpu_ms = middleTimes(way.cpu_ms);
  const double median_ms = quantile(cpu_ms, 0.5);
  state.counters[way.name + "_ms"] = median_ms;
  state.counters[way.name + "_wall_ms"] = quantile(middleTimes(way.wall_ms), 0.5);
  state.counters[way.name + "_ratio"] = reference_ms / median_ms;
  state.counters[way.name + "_p95_over_median"] = quantile(cpu_ms, 0.95) / median_ms;
}

/// Free and occupied columns [m2].
double knownArea(const OccupancyMap& map) {
  std::vector<Cell> columns;
  testing::forEachVoxel(map.tree(), [&](const octomap::OcTreeKey& key, bool) {
    columns.push_back({key[0], key[1]});
  });
  std::sort(columns.begin(), columns.end());
  const auto end = std::unique(columns.begin(), columns.end());
  const double cell_m = map.config().resolution_m;
  return cell_m * cell_m * static_cast<double>(end - columns.begin());
}

void integrate(benchmark::State& state, std::size_t frames, double max_depth_m,
               const FrameSource& frameAt) {
  DepthProjector projector({kStride, 0.01, max_depth_m, BeyondMaxDepth::kDrop});
  for (auto _ : state) {
    OctomapWay full(Discretize::kNo);
    OctomapWay discretized(Discretize::kYes);
    Way octomap{"octomap"};
    Way octomap_discretized{"octomap_discretized"};
    std::vector<MapWay> ours;
    ours.emplace_back("exact", IntegrationMode::kExact, 1);
    ours.emplace_back("fast", IntegrationMode::kFast, 1);
    ours.emplace_back("exact_2_threads", IntegrationMode::kExact, 2);
    for (std::size_t first = 0; first < frames; first += kTurn_frames) {
      std::vector<RangeImage> images;
      for (std::size_t i = first; i < std::min(frames, first + kTurn_frames); ++i) {
        const DepthFrame frame = frameAt(i);
        images.push_back(projector.projectLattice(frame.depth, frame.camera, frame.T_map_camera));
      }
      for (const RangeImage& image : images) full.take(image, octomap);
      for (const RangeImage& image : images) discretized.take(image, octomap_discretized);
      for (std::size_t attempt = 0; attempt < kAttempts; ++attempt)
        for (MapWay& way : ours) way.take(images, attempt);
    }
    const double reference_ms = quantile(middleTimes(octomap.cpu_ms), 0.5);
    for (const Way* way : {&octomap, &octomap_discretized}) report(state, *way, reference_ms);
    for (const MapWay& way : ours) report(state, way.way, reference_ms);
    const auto wall_ms = [&](std::size_t way) {
      return quantile(middleTimes(ours[way].way.wall_ms), 0.5);
    };
    state.counters["thread_speedup"] = wall_ms(0) / wall_ms(2);
    state.counters["frames"] = static_cast<double>(frames);
    const OccupancyMap& map = ours.front().maps.front();
    state.counters["bytes_per_m2"] = static_cast<double>(map.memoryBytes()) / knownArea(map);
  }
}

/// The image as a camera of half the resolution sees it.
DepthFrame halved(DepthFrame frame) {
  cv::Mat pixels(frame.depth.pixels.rows / 2, frame.depth.pixels.cols / 2, CV_16UC1);
  for (int v = 0; v < pixels.rows; ++v)
    for (int u = 0; u < pixels.cols; ++u)
      pixels.at<std::uint16_t>(v, u) = frame.depth.pixels.at<std::uint16_t>(2 * v, 2 * u);
  frame.depth.pixels = pixels;
  frame.camera = {pixels.cols,         pixels.rows,         frame.camera.fx / 2,
                  frame.camera.fy / 2, frame.camera.cx / 2, frame.camera.cy / 2};
  return frame;
}

template <typename Run>
void add(const std::string& name, Run&& run) {
  benchmark::RegisterBenchmark(("integration/" + name).c_str(), std::forward<Run>(run))
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
}

void addRecording(const std::string& folder) {
  const std::string scene = std::filesystem::path(folder).filename().string();
  const bool is_vga = SequenceReader(folder).camera().width >= 640;
  const auto run = [folder](benchmark::State& state, bool half) {
    const SequenceReader sequence(folder);
    integrate(state, std::min(sequence.size(), kMostFrames), 10.0, [&](std::size_t i) {
      return half ? halved(sequence.read(i)) : static_cast<DepthFrame>(sequence.read(i));
    });
  };
  add(scene, [run](benchmark::State& state) { run(state, false); });
  if (is_vga) add(scene + "_320x240", [run](benchmark::State& state) { run(state, true); });
}

/// A robot at 1.2 m/s whose camera gives `step` times fewer images than 30 a second.
void addDeepBuilding(const std::string& name, std::size_t step, testing::DepthNoise noise,
                     bool half) {
  add(name, [=](benchmark::State& state) {
    const testing::BoxWorld world = testing::deepBuilding();
    integrate(state, kDeepFrames, 65.0, [&](std::size_t i) {
      const DepthFrame frame = testing::deepFrame(world, step * i, kStride, noise);
      return half ? halved(frame) : frame;
    });
  });
}

void addRecordings(const std::string& folder) {
  if (folder.empty() || !std::filesystem::is_directory(folder)) {
    std::cerr << "OCCUSG_RGBD_DIR is no folder: benchmarks over its recordings are left out\n";
    return;
  }
  std::vector<std::string> recordings;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (std::filesystem::exists(entry.path() / "depth.txt"))
      recordings.push_back(entry.path().string());
  std::sort(recordings.begin(), recordings.end());
  for (const std::string& recording : recordings) addRecording(recording);
}

}  // namespace
}  // namespace occusg

int main(int argc, char** argv) {
  using occusg::testing::DepthNoise;
  occusg::addRecording(OCCUSG_EXAMPLES_DIR "/apartment");
  occusg::addRecordings(OCCUSG_RGBD_DIR);
  occusg::addDeepBuilding("deep", 1, DepthNoise::kNone, false);
  occusg::addDeepBuilding("deep_noisy", 1, DepthNoise::kStereo, false);
  occusg::addDeepBuilding("deep_5_hz", 6, DepthNoise::kNone, false);
  occusg::addDeepBuilding("deep_320x240", 1, DepthNoise::kNone, true);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
