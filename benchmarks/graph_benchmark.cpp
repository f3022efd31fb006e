// SPDX-License-Identifier: BSD-3-Clause
#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <memory>
#include <utility>
#include <vector>

#include "occusg/graph/graph_builder.hpp"

/// Assembly of one update of the scene graph, of graphs of different size with the same local
/// change, in CPU time, so that other programs do not count. Prints a table, and as the last line
/// one JSON object.
namespace {

using namespace occusg;

constexpr int kRoomCells = 105;  // 7 x 7 blocks: 49 navigation nodes a room
constexpr int kDoorCells = 18;
constexpr int kObjectsPerRoom = 13;
constexpr double kResolution_m = 0.05;
constexpr int kUpdates = 400;

/// Square rooms in a square building, a door in each wall between two.
class Building {
 public:
  explicit Building(int rooms) : rooms_(rooms), columns_(squareSide(rooms)) {
    layer_.frame.resolution_m = kResolution_m;
    const int rows = (rooms + columns_ - 1) / columns_;
    layer_.cells = FreeSpaceCells({{0, 0}, {columns_ * kRoomCells, rows * kRoomCells}}, kUnknown);
    for (int room = 0; room < rooms; ++room) paintRoom(room);
    for (int room = 0; room < rooms; ++room) joinRoom(room);
  }

  /// The room in the middle.
  [[nodiscard]] int middle() const { return (rooms_ / columns_ / 2) * columns_ + columns_ / 2; }
  [[nodiscard]] Point2 center(int room) const {
    return layer_.frame.corner(
        {column(room) * kRoomCells + kRoomCells / 2, row(room) * kRoomCells + kRoomCells / 2});
  }
  [[nodiscard]] const FreeSpace& layer() const { return layer_; }

  /// The regions as the tracker tells them; those of the middle room and of the one before it with
  /// another boundary when `variant` is 1.
  [[nodiscard]] TrackedRegions regions(int variant) const {
    TrackedRegions tracked;
    tracked.decomposition.frame = layer_.frame;
    for (int room = 0; room < rooms_; ++room) {
      const bool is_near = room == middle() || room == middle() - 1;
      tracked.decomposition.regions.push_back(regionOf(room, is_near ? variant : 0));
    }
    tracked.decomposition.crossings = crossings_;
    tracked.changed = {middle(), middle() + 1};
    tracked.crossings_changed = false;
    return tracked;
  }

  /// Puts a square metre of obstacles into the middle room, or takes it away.
  CellBox change(int variant) {
    const Cell corner = layer_.frame.cellAt(center(middle()));
    const CellBox box{{corner.x + 10, corner.y + 10}, {corner.x + 30, corner.y + 30}};
    paint(box, variant == 0 ? kFree : kFullObstacle);
    return box;
  }

  [[nodiscard]] std::vector<Detection> objectsOf(int room, double offset_m) const {
    std::vector<Detection> detections;
    for (int i = 0; i < kObjectsPerRoom; ++i) {
      Detection detection;
      detection.class_name = i % 2 == 0 ? "chair" : "office_desk";
      detection.score = 0.9;
      const Point2 at = center(room);
      detection.centroid = {at.x - 2.0 + 1.2 * (i % 4) + offset_m, at.y - 2.0 + 1.2 * (i / 4), 0.4};
      const Eigen::Vector3d half(0.25, 0.25, 0.4);
      detection.box = {Eigen::Vector3d(detection.centroid - half),
                       Eigen::Vector3d(detection.centroid + half)};
      detections.push_back(detection);
    }
    return detections;
  }

 private:
  static int squareSide(int rooms) {
    return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(rooms))));
  }
  [[nodiscard]] int column(int room) const { return room % columns_; }
  [[nodiscard]] int row(int room) const { return room / columns_; }

  void paint(const CellBox& box, std::int8_t value) {
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) layer_.cells.at({x, y}) = value;
  }

  void paintRoom(int room) {
    const Cell corner{column(room) * kRoomCells, row(room) * kRoomCells};
    paint({corner, {corner.x + kRoomCells, corner.y + kRoomCells}}, kFullObstacle);
    paint({{corner.x + 1, corner.y + 1}, {corner.x + kRoomCells - 1, corner.y + kRoomCells - 1}},
          kFree);
  }

  void joinRoom(int room) {
    const Cell corner{column(room) * kRoomCells, row(room) * kRoomCells};
    const int low = (kRoomCells - kDoorCells) / 2;
    if (column(room) + 1 < columns_ && room + 1 < rooms_) {
      const int x = corner.x + kRoomCells;
      paint({{x - 1, corner.y + low}, {x + 1, corner.y + low + kDoorCells}}, kFree);
      addCrossing(room, room + 1, {x, corner.y + low}, {x, corner.y + low + kDoorCells});
    }
    if (room + columns_ < rooms_) {
      const int y = corner.y + kRoomCells;
      paint({{corner.x + low, y - 1}, {corner.x + low + kDoorCells, y + 1}}, kFree);
      addCrossing(room, room + columns_, {corner.x + low, y}, {corner.x + low + kDoorCells, y});
    }
  }

  void addCrossing(int a, int b, const Cell& from, const Cell& to) {
    crossings_.push_back({a + 1, b + 1, {layer_.frame.corner(from), layer_.frame.corner(to)}});
  }

  /// A square with a notched boundary, as regions of cells have.
  [[nodiscard]] Region regionOf(int room, int variant) const {
    constexpr int kNotches = 12;
    const Cell low{column(room) * kRoomCells + 1, row(room) * kRoomCells + 1};
    const int side = kRoomCells - 2;
    Region region;
    region.id = room + 1;
    const auto add = [&](int x, int y) {
      region.polygon.outer.push_back(layer_.frame.corner({low.x + x, low.y + y}));
    };
    add(0, 0);
    for (int i = 0; i < kNotches; ++i) {
      add(4 + 8 * i, 0);
      add(4 + 8 * i, 1 + variant);
      add(8 + 8 * i, 1 + variant);
      add(8 + 8 * i, 0);
    }
    add(side, 0);
    add(side, side);
    add(0, side);
    region.area_m2 = area(region.polygon);
    region.centroid = centroid(region.polygon);
    return region;
  }

  int rooms_;
  int columns_;
  FreeSpace layer_;
  std::vector<Crossing> crossings_;
};

struct Figures {
  int rooms = 0;
  double median_ms = 0.0;
  double max_ms = 0.0;
  std::size_t navigation_nodes = 0;
  std::size_t objects = 0;
};

/// Surfaces of the objects, as a depth camera sees them from above.
octomap::OcTree surfacesOf(const std::vector<Detection>& objects) {
  octomap::OcTree tree(kResolution_m);
  for (const Detection& object : objects) {
    for (double y = object.box.min().y() + 0.025; y < object.box.max().y(); y += kResolution_m)
      for (double x = object.box.min().x() + 0.025; x < object.box.max().x(); x += kResolution_m)
        tree.updateNode(x, y, object.box.max().z() - 0.025, true, true);
  }
  tree.updateInnerOccupancy();
  return tree;
}

/// A robot in the middle of a building, update after update.
class Drive {
 public:
  explicit Drive(int rooms)
      : rooms_(rooms),
        building_(rooms),
        variants_{building_.regions(0), building_.regions(1)},
        tree_(surfacesOf(building_.objectsOf(building_.middle(), 0.0))),
        builder_(GraphBuilderConfig{}) {
    for (int room = 0; room < rooms; ++room)
      builder_.observeObjects(building_.objectsOf(room, 0.0), 0.0);
  }

  void update(int i) {
    constexpr int kWarmUp = 20;  // rooms are promoted once they are four seconds old
    const int variant = i % 2;
    const CellBox changed = i == 0 ? building_.layer().cells.box() : building_.change(variant);
    const auto detections = building_.objectsOf(building_.middle(), 0.02 * variant);
    const Point2 at = building_.center(building_.middle());
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(at.x + 0.5 * (i % 4), at.y, 1.0);
    TrackedRegions& regions = variants_[static_cast<std::size_t>(variant)];
    regions.update = static_cast<std::uint64_t>(i) + 1;
    const MapView map{&building_.layer(), changed, &tree_, 8.0};
    const double stamp_s = 0.5 * i;
    const std::clock_t begin = std::clock();
    builder_.observeObjects(detections, stamp_s);
    builder_.update(regions, pose, stamp_s, map);
    if (i >= kWarmUp)
      times_ms_.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }

  [[nodiscard]] Figures figures() const {
    std::vector<double> times_ms = times_ms_;
    std::sort(times_ms.begin(), times_ms.end());
    return {rooms_, times_ms[times_ms.size() / 2], times_ms.back(),
            builder_.graph().nodes(NodeType::kNavigation).size(),
            builder_.graph().nodes(NodeType::kObject).size()};
  }

 private:
  int rooms_;
  Building building_;
  std::array<TrackedRegions, 2> variants_;
  octomap::OcTree tree_;
  GraphBuilder builder_;
  std::vector<double> times_ms_;
};

}  // namespace

int main() {
  // In turn, so that what else the machine does slows all of them alike, and no graph finds its
  // data in the cache: between two updates of a robot there is mapping.
  std::vector<std::unique_ptr<Drive>> drives;
  for (const int rooms : {10, 40, 100, 1000}) drives.push_back(std::make_unique<Drive>(rooms));
  for (int i = 0; i < kUpdates; ++i)
    for (const auto& drive : drives) drive->update(i);

  std::printf("%6s %12s %8s %10s %8s\n", "rooms", "navigation", "objects", "median ms", "max ms");
  std::vector<Figures> table;
  for (const auto& drive : drives) {
    table.push_back(drive->figures());
    const Figures& figures = table.back();
    std::printf("%6d %12zu %8zu %10.3f %8.3f\n", figures.rooms, figures.navigation_nodes,
                figures.objects, figures.median_ms, figures.max_ms);
  }
  const Figures& of_40 = table[1];
  std::printf("{\"median_ms\": %.4f, \"max_ms\": %.4f, \"growth_10_to_1000\": %.3f}\n",
              of_40.median_ms, of_40.max_ms, table.back().median_ms / table.front().median_ms);
  return 0;
}
