// SPDX-License-Identifier: BSD-3-Clause
// A long drive through a generated building nobody has seen before: whether the cost of a frame
// grows with the map. Prints a table of tenths of the drive and, last, one JSON object. Times are
// CPU times of one thread. Three free-space layers take turns at each frame and their middle time
// counts: the slowest of 7200 frames is a frame, not whatever else the machine did.
// Usage: driving_benchmark [FRAMES [AREA_M2]]   (7200 frames, 2 a second for an hour, in 10 000 m2)
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

#include "generated_building.hpp"
#include "median.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "thread_clock.hpp"

namespace occusg {
namespace {

constexpr int kParts = 10;
constexpr std::size_t kLayers = 3;

struct FrameTime {
  double occupancy_ms = 0.0;
  double free_space_ms = 0.0;
};

/// Resident memory of the process [MiB].
double residentMemory() {
  std::ifstream statm("/proc/self/statm");
  double total_pages = 0.0;
  double resident_pages = 0.0;
  statm >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

struct Part {
  double occupancy_ms = 0.0;  ///< Median, as the next.
  double free_space_ms = 0.0;
  double worst_free_space_ms = 0.0;
};

Part summaryOf(const std::vector<FrameTime>& times) {
  std::vector<double> occupancy_ms;
  std::vector<double> free_space_ms;
  for (const FrameTime& time : times) {
    occupancy_ms.push_back(time.occupancy_ms);
    free_space_ms.push_back(time.free_space_ms);
  }
  return {median(occupancy_ms), median(free_space_ms),
          *std::max_element(free_space_ms.begin(), free_space_ms.end())};
}

/// The whole hour covers the building once, whatever the number of frames.
double lengthOf(const GeneratedBuilding& building) {
  constexpr double kRoom_m = 5.2;
  return building.rooms_x * building.rooms_y * kRoom_m;
}

/// Free-space layers of one map.
class Layers {
 public:
  /// Gives all of them the change, another one first than the last time.
  /// @return the middle time [ms].
  double update(const OccupancyMap& map, const MapChange& change) {
    std::array<double, kLayers> times_ms{};
    for (double& time_ms : times_ms) {
      const double start_s = threadTime();
      (void)layers_[next_].update(map, change);
      time_ms = 1e3 * (threadTime() - start_s);
      next_ = (next_ + 1) % kLayers;
    }
    next_ = (next_ + 1) % kLayers;
    std::sort(times_ms.begin(), times_ms.end());
    return times_ms[kLayers / 2];
  }

  [[nodiscard]] std::size_t memoryBytesOfOne() const { return layers_.front().memoryBytes(); }

 private:
  std::vector<FreeSpaceLayer> layers_{kLayers, FreeSpaceLayer({}, GridFrame{0.05})};
  std::size_t next_ = 0;
};

void run(int frames, double area_m2) {
  const GeneratedBuilding building = buildingOf(area_m2);
  const double length_m = lengthOf(building);
  const std::vector<CameraPlace> places = drive(building, 0, length_m, length_m / frames);
  OccupancyMapConfig config;
  config.max_memory_mb = 1e6;  // the whole building, whatever it takes
  OccupancyMap map{config};
  Layers layers;
  std::vector<Part> parts;
  std::cout << std::fixed << std::setprecision(3)
            << "part  occupancy ms  free space ms  worst ms  resident MiB\n";
  for (int part = 0; part < kParts; ++part) {
    std::vector<FrameTime> times;
    const std::size_t end = places.size() * static_cast<std::size_t>(part + 1) / kParts;
    for (std::size_t i = places.size() * static_cast<std::size_t>(part) / kParts; i < end; ++i) {
      const RangeImage image = seenIn(building, places[i]);
      const double start_s = threadTime();
      const MapChange change = map.insert(image);
      const double occupancy_ms = 1e3 * (threadTime() - start_s);
      times.push_back({occupancy_ms, layers.update(map, change)});
    }
    parts.push_back(summaryOf(times));
    std::cout << std::setw(4) << part + 1 << std::setw(14) << parts.back().occupancy_ms
              << std::setw(15) << parts.back().free_space_ms << std::setw(10)
              << parts.back().worst_free_space_ms << std::setw(14) << residentMemory() << std::endl;
  }
  const double first_ms = parts.front().occupancy_ms + parts.front().free_space_ms;
  const double last_ms = parts.back().occupancy_ms + parts.back().free_space_ms;
  std::cout << "{\"frames\": " << places.size() << ", \"area_m2\": " << building.area()
            << ", \"first_tenth_ms\": " << first_ms << ", \"last_tenth_ms\": " << last_ms
            << ", \"growth\": " << last_ms / first_ms << ", \"free_space_growth\": "
            << parts.back().free_space_ms / parts.front().free_space_ms
            << ", \"layer_bytes_per_m2\": "
            << static_cast<double>(layers.memoryBytesOfOne()) / building.area()
            << ", \"map_bytes_per_m2\": "
            << static_cast<double>(map.memoryBytes()) / building.area() << "}\n";
}

}  // namespace
}  // namespace occusg

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::atoi(argv[1]) : 7200;
  const double area_m2 = argc > 2 ? std::atof(argv[2]) : 10000.0;
  if (argc > 3 || frames < 10 || !(area_m2 >= 1.0 && area_m2 <= 1e6)) {
    std::cerr << "usage: driving_benchmark [FRAMES [AREA_M2]]\n";
    return 2;
  }
  occusg::run(frames, area_m2);
  return 0;
}
