// SPDX-License-Identifier: BSD-3-Clause
// What an update of the regions costs in buildings of 100, 1000 and 10 000 m2: a camera drives
// through two rooms that nobody has seen yet, the rest of the building is known. So the change is
// the same in all of them. Every frame goes through all stages. Prints a table and, last, one JSON
// object. Times are CPU times of one thread; the buildings take turns at each frame, so that what
// else the machine does slows all of them alike. Usage: regions_benchmark
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "generated_building.hpp"
#include "median.hpp"
#include "occusg/graph/graph_builder.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/regions/constriction_decomposer.hpp"
#include "occusg/regions/region_tracker.hpp"
#include "thread_clock.hpp"

namespace occusg {
namespace {

constexpr double kStep_m = 0.05;
constexpr int kUnknownRooms = 2;
constexpr double kFramePeriod_s = 0.5;
constexpr double kRoom_m = 5.2;

OccupancyMapConfig mapConfig() {
  OccupancyMapConfig config;
  config.max_memory_mb = 1e6;  // the whole building, whatever it takes
  return config;
}

/// A building, what is known of it, and a camera on its way.
class Drive {
 public:
  explicit Drive(double area_m2)
      : building_(buildingOf(area_m2)),
        map_(mapConfig()),
        layer_({}, GridFrame{0.05}),
        decomposer_({}),
        tracker_({}),
        graph_({}) {
    explore(building_, kUnknownRooms, map_, RowEnd::kEast);
    places_ = drive({kUnknownRooms, building_.rooms_y}, building_.rooms_y - 1,
                    (kUnknownRooms - 1) * kRoom_m, kStep_m);
    for (CameraPlace& place : places_) place.x_m += (building_.rooms_x - kUnknownRooms) * kRoom_m;
    (void)layer_.recompute(map_);
    (void)regionsOf(layer_.freeSpace(), layer_.freeSpace().cells.box());
  }

  [[nodiscard]] std::size_t frames() const { return places_.size(); }

  void process(std::size_t i) {
    const RangeImage image = seenIn(building_, places_[i]);
    const double begin_s = threadTime();
    const FreeSpace& layer = layer_.update(map_, map_.insert(image));
    const double mapped_s = threadTime();
    const TrackedRegions& tracked = regionsOf(layer, layer.changed.including(layer.gaps_changed));
    const double tracked_s = threadTime();
    const MapView view{&layer, layer.changed, &map_.tree(), 8.0, layer.gaps_changed};
    (void)graph_.update(tracked, image.T_map_camera, kFramePeriod_s * static_cast<double>(i), view);
    const double end_s = threadTime();
    mapping_ms_.push_back(1e3 * (mapped_s - begin_s));
    update_ms_.push_back(1e3 * (tracked_s - mapped_s));
    graph_ms_.push_back(1e3 * (end_s - tracked_s));
    frame_ms_.push_back(1e3 * (end_s - begin_s));
  }

  void print() const {
    std::printf("%8.0f %8zu %8zu %12.3f %12.3f %12.3f %12.3f %12.3f %12.3f\n", building_.area(),
                tracker_.regions().decomposition.regions.size(), frames(), median(update_ms_),
                worst(), median(mapping_ms_), median(graph_ms_),
                *std::max_element(graph_ms_.begin(), graph_ms_.end()), median(frame_ms_));
  }

  [[nodiscard]] double updateMedian() const { return median(update_ms_); }
  [[nodiscard]] double worst() const {
    return *std::max_element(update_ms_.begin(), update_ms_.end());
  }
  [[nodiscard]] double frameMedian() const { return median(frame_ms_); }

  /// Of map, layer and regions.
  [[nodiscard]] double bytesPerSquareMetre() const {
    const std::size_t labels = tracker_.regions().decomposition.labels.values().size();
    const std::size_t bytes = map_.memoryBytes() + layer_.memoryBytes() +
                              decomposer_.memoryBytes() + labels * sizeof(std::int32_t);
    return static_cast<double>(bytes) / building_.area();
  }

 private:
  const TrackedRegions& regionsOf(const FreeSpace& layer, const CellBox& changed) {
    return tracker_.update(decomposer_.update(layer, changed));
  }

  GeneratedBuilding building_;
  OccupancyMap map_;
  FreeSpaceLayer layer_;
  ConstrictionDecomposer decomposer_;
  RegionTracker tracker_;
  GraphBuilder graph_;
  std::vector<CameraPlace> places_;
  std::vector<double> mapping_ms_;
  std::vector<double> update_ms_;
  std::vector<double> graph_ms_;
  std::vector<double> frame_ms_;
};

constexpr std::array<int, 3> kAreas_m2 = {100, 1000, 10000};

template <typename Value>
std::string perArea(const std::vector<std::unique_ptr<Drive>>& drives, const Value& value) {
  std::string text;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    std::array<char, 64> item{};
    std::snprintf(item.data(), item.size(), "%s\"%d\": %.3f", i == 0 ? "" : ", ", kAreas_m2[i],
                  value(*drives[i]));
    text += item.data();
  }
  return "{" + text + "}";
}

void run() {
  std::vector<std::unique_ptr<Drive>> drives;
  std::size_t frames = 0;
  for (const int area_m2 : kAreas_m2) {
    drives.push_back(std::make_unique<Drive>(area_m2));
    frames = std::max(frames, drives.back()->frames());
  }
  for (std::size_t i = 0; i < frames; ++i)
    for (const auto& drive : drives)
      if (i < drive->frames()) drive->process(i);

  std::printf("%8s %8s %8s %12s %12s %12s %12s %12s %12s\n", "area m2", "regions", "frames",
              "update ms", "worst ms", "mapping ms", "graph ms", "worst ms", "frame ms");
  for (const auto& drive : drives) drive->print();
  std::printf(
      "{\"median_ms\": %s, \"worst_ms\": %s, \"frame_median_ms\": %s, \"bytes_per_m2\": %.0f}\n",
      perArea(drives, [](const Drive& drive) { return drive.updateMedian(); }).c_str(),
      perArea(drives, [](const Drive& drive) { return drive.worst(); }).c_str(),
      perArea(drives, [](const Drive& drive) { return drive.frameMedian(); }).c_str(),
      drives.back()->bytesPerSquareMetre());
}

}  // namespace
}  // namespace occusg

int main() {
  occusg::run();
  return 0;
}
