// SPDX-License-Identifier: BSD-3-Clause
#include "storey_rooms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace occusg::apps {
namespace {

/// Floors that lie farther apart are of different storeys.
constexpr double kSameFloor_m = 1.0;
/// Between storeys put side by side; beyond what an alignment may shift.
constexpr double kApart_m = 1000.0;

StoreyRooms* storeyNear(std::vector<StoreyRooms>& storeys, double floor_z_m, double most_m) {
  StoreyRooms* nearest = nullptr;
  for (StoreyRooms& storey : storeys) {
    const double apart_m = std::abs(storey.floor_z_m - floor_z_m);
    if (apart_m > most_m) continue;
    if (nearest == nullptr || apart_m < std::abs(nearest->floor_z_m - floor_z_m)) nearest = &storey;
  }
  return nearest;
}

/// Least and greatest x of rooms [m].
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(const std::vector<EvaluatedRoom>& rooms) {
    for (const EvaluatedRoom& room : rooms) {
      for (const Polygon& part : room.parts) {
        const Bounds2 box = bounds(part);
        low = std::min(low, box.min.x);
        high = std::max(high, box.max.x);
      }
    }
  }
};

double widthOf(const std::vector<StoreyRooms>& storeys) {
  Extent extent;
  for (const StoreyRooms& storey : storeys) {
    extent.include(storey.predicted);
    extent.include(storey.truth);
  }
  return std::max(0.0, extent.high - extent.low);
}

}  // namespace

std::vector<StoreyRooms> byStorey(const std::vector<RoomOnStorey>& predicted,
                                  const std::vector<RoomOnStorey>& truth) {
  std::vector<StoreyRooms> storeys;
  for (const RoomOnStorey& room : truth) {
    StoreyRooms* storey = storeyNear(storeys, room.floor_z_m, 0.0);
    if (storey == nullptr)
      storey = &storeys.emplace_back(StoreyRooms{room.floor_z_m, true, {}, {}});
    storey->truth.push_back(room.room);
  }
  std::vector<StoreyRooms> further;
  for (const RoomOnStorey& room : predicted) {
    StoreyRooms* storey = storeyNear(storeys, room.floor_z_m, kSameFloor_m);
    if (storey == nullptr) storey = storeyNear(further, room.floor_z_m, 0.0);
    if (storey == nullptr)
      storey = &further.emplace_back(StoreyRooms{room.floor_z_m, false, {}, {}});
    storey->predicted.push_back(room.room);
  }
  storeys.insert(storeys.end(), further.begin(), further.end());
  std::sort(storeys.begin(), storeys.end(),
            [](const StoreyRooms& a, const StoreyRooms& b) { return a.floor_z_m < b.floor_z_m; });
  return storeys;
}

StoreyRooms sideBySide(const std::vector<StoreyRooms>& storeys) {
  const double step_m = widthOf(storeys) + kApart_m;
  StoreyRooms all;
  for (std::size_t i = 0; i < storeys.size(); ++i) {
    const Point2 shift{step_m * static_cast<double>(i), 0.0};
    for (const EvaluatedRoom& room : storeys[i].predicted)
      all.predicted.push_back(translated(room, shift));
    for (const EvaluatedRoom& room : storeys[i].truth) all.truth.push_back(translated(room, shift));
  }
  return all;
}

}  // namespace occusg::apps
