// SPDX-License-Identifier: BSD-3-Clause
#include "generated_building.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "mapping/voxel_tree.hpp"

namespace occusg {
namespace {

constexpr double kResolution_m = 0.05;
constexpr int kPitch = 104;  ///< Voxels; 13 blocks of the tree.
constexpr int kBlockSide = 8;
constexpr int kBlocks = kPitch / kBlockSide;
constexpr int kWall = 2;
constexpr int kRoomHeight = 52;
constexpr int kDoorHeight = 40;
constexpr VoxelRun kDoor{44, 62};  ///< Along the wall.
constexpr double kPitch_m = kPitch * kResolution_m;
constexpr double kCameraHeight_m = 1.2;
constexpr double kFarthest_m = 10.0;

Point3f toPoint3f(const Eigen::Vector3d& point) {
  return {static_cast<float>(point.x()), static_cast<float>(point.y()),
          static_cast<float>(point.z())};
}

/// Which sides of a room have a door; the eastern and northern wall belong to the next room, if
/// there is one.
struct RoomKind {
  bool west = false;
  bool south = false;
  bool east = false;
  bool north = false;
  [[nodiscard]] int number() const {
    return (west ? 1 : 0) + (south ? 2 : 0) + (east ? 4 : 0) + (north ? 8 : 0);
  }
};

RoomKind kindOf(const GeneratedBuilding& building, int x, int y) {
  return {x > 0, y > 0, x + 1 < building.rooms_x, y + 1 < building.rooms_y};
}

bool isIn(int value, int low, int high) { return value >= low && value < high; }

struct Furniture {
  std::array<int, 3> min;
  std::array<int, 3> max;
};
constexpr std::array<Furniture, 2> kFurniture = {
    {{{12, 2, 0}, {32, 14, 36}}, {{64, 68, 14}, {88, 84, 15}}}};

/// Voxel of a room, its own south-west corner and floor being zero; one voxel beyond it is solid.
bool isSolid(const RoomKind& room, int x, int y, int z) {
  if (!isIn(z, 0, kRoomHeight)) return true;
  const auto isWall = [&](int across, int along, bool low_door, bool high_door) {
    const bool low = across < kWall;
    const bool high = across >= kPitch - (high_door ? 0 : kWall);
    if (!low && !high) return false;
    const bool in_door = isIn(along, kDoor.bottom, kDoor.top) && z < kDoorHeight;
    return !(in_door && (low ? low_door : high_door));
  };
  if (isWall(x, y, room.west, room.east) || isWall(y, x, room.south, room.north)) return true;
  return std::any_of(kFurniture.begin(), kFurniture.end(), [&](const Furniture& box) {
    return isIn(x, box.min[0], box.max[0]) && isIn(y, box.min[1], box.max[1]) &&
           isIn(z, box.min[2], box.max[2]);
  });
}

enum class VoxelState { kUnknown, kFree, kOccupied };

VoxelState stateOf(const RoomKind& room, int x, int y, int z) {
  if (!isSolid(room, x, y, z)) return VoxelState::kFree;
  const bool has_surface = !isSolid(room, x - 1, y, z) || !isSolid(room, x + 1, y, z) ||
                           !isSolid(room, x, y - 1, z) || !isSolid(room, x, y + 1, z) ||
                           !isSolid(room, x, y, z - 1) || !isSolid(room, x, y, z + 1);
  return has_surface ? VoxelState::kOccupied : VoxelState::kUnknown;
}

/// Bits of a number, three places apart.
std::uint64_t spread(int number) {
  std::uint64_t bits = 0;
  for (unsigned i = 0; i < 13; ++i)
    bits |= static_cast<std::uint64_t>((static_cast<unsigned>(number) >> i) & 1U) << (3 * i);
  return bits;
}

/// A block of a room and where it lies in it, in blocks.
struct RoomBlock {
  std::array<int, 3> place{};
  VoxelBlock block;
};

std::vector<RoomBlock> blocksOf(const RoomKind& room) {
  std::vector<RoomBlock> blocks;
  for (int bz = -1; bz <= kRoomHeight / kBlockSide; ++bz)
    for (int by = 0; by < kBlocks; ++by)
      for (int bx = 0; bx < kBlocks; ++bx) {
        RoomBlock result{{bx, by, bz}, {}};
        bool is_known = false;
        for (int i = 0; i < kBlockSide * kBlockSide * kBlockSide; ++i) {
          const std::array<int, 3> in = {i % kBlockSide, i / kBlockSide % kBlockSide,
                                         i / kBlockSide / kBlockSide};
          const VoxelState state = stateOf(room, kBlockSide * bx + in[0], kBlockSide * by + in[1],
                                           kBlockSide * bz + in[2]);
          if (state == VoxelState::kUnknown) continue;
          is_known = true;
          const auto voxel =
              static_cast<unsigned>(spread(in[0]) | spread(in[1]) << 1 | spread(in[2]) << 2);
          auto& words = state == VoxelState::kFree ? result.block.free : result.block.occupied;
          words[voxel >> 6] |= std::uint64_t{1} << (voxel & 63U);
        }
        if (is_known) blocks.push_back(result);
      }
  return blocks;
}

/// The room's blocks at their place in the building.
std::vector<VoxelBlock> placed(const std::vector<RoomBlock>& blocks, int room_x, int room_y) {
  constexpr int kZeroBlock = kZeroKey / kBlockSide;
  std::vector<VoxelBlock> result;
  for (const RoomBlock& block : blocks) {
    result.push_back(block.block);
    result.back().code = spread(kZeroBlock + kBlocks * room_x + block.place[0]) |
                         spread(kZeroBlock + kBlocks * room_y + block.place[1]) << 1 |
                         spread(kZeroBlock + block.place[2]) << 2;
  }
  std::sort(result.begin(), result.end(),
            [](const VoxelBlock& a, const VoxelBlock& b) { return a.code < b.code; });
  return result;
}

/// A ray in metres.
struct Ray {
  std::array<double, 3> from;
  std::array<double, 3> direction;
  [[nodiscard]] double at(int axis, double t) const {
    return from[static_cast<std::size_t>(axis)] + t * direction[static_cast<std::size_t>(axis)];
  }
};

bool passesDoor(const Ray& ray, int along, double t) {
  const double place = ray.at(along, t) / kResolution_m;
  const double in_room = place - kPitch * std::floor(place / kPitch);
  return in_room >= kDoor.bottom && in_room < kDoor.top &&
         ray.at(2, t) < kDoorHeight * kResolution_m;
}

/// Where the ray meets a wall that stands across `axis`.
double hitWall(const Ray& ray, int axis, int rooms, double farthest) {
  const double speed = ray.direction[static_cast<std::size_t>(axis)];
  if (std::abs(speed) < 1e-9) return farthest;
  const int step = speed > 0.0 ? 1 : -1;
  const double start = ray.at(axis, 0.0) / kPitch_m;
  for (int wall = static_cast<int>(speed > 0.0 ? std::ceil(start) : std::floor(start));;
       wall += step) {
    const double low_m = wall * kPitch_m - (wall == rooms ? kWall * kResolution_m : 0.0);
    const double high_m = low_m + kWall * kResolution_m;
    const double enter = ((speed > 0.0 ? low_m : high_m) - ray.at(axis, 0.0)) / speed;
    const double leave = ((speed > 0.0 ? high_m : low_m) - ray.at(axis, 0.0)) / speed;
    if (enter >= farthest) return farthest;
    if (leave < 0.0) continue;
    const bool is_outer = wall <= 0 || wall >= rooms;
    if (is_outer || !passesDoor(ray, 1 - axis, enter)) return std::max(0.0, enter);
    if (!passesDoor(ray, 1 - axis, leave)) return leave;
  }
}

double hitFurniture(const Ray& ray, int room_x, int room_y, double farthest) {
  const std::array<double, 3> corner = {room_x * kPitch_m, room_y * kPitch_m, 0.0};
  for (const Furniture& box : kFurniture) {
    double enter = 0.0;
    double leave = farthest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = ray.from[axis] - corner[axis];
      const double a = (box.min[axis] * kResolution_m - from) / ray.direction[axis];
      const double b = (box.max[axis] * kResolution_m - from) / ray.direction[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter <= leave) farthest = enter;
  }
  return farthest;
}

double hit(const GeneratedBuilding& building, const Ray& ray) {
  double nearest = kFarthest_m;
  if (ray.direction[2] < 0.0) nearest = std::min(nearest, -ray.from[2] / ray.direction[2]);
  if (ray.direction[2] > 0.0)
    nearest = std::min(nearest, (kRoomHeight * kResolution_m - ray.from[2]) / ray.direction[2]);
  nearest = hitWall(ray, 0, building.rooms_x, nearest);
  nearest = hitWall(ray, 1, building.rooms_y, nearest);
  const auto roomOf = [](double place_m) {
    return static_cast<int>(std::floor(place_m / kPitch_m));
  };
  const std::array<int, 2> from = {roomOf(ray.at(0, 0.0)), roomOf(ray.at(1, 0.0))};
  const std::array<int, 2> to = {roomOf(ray.at(0, nearest)), roomOf(ray.at(1, nearest))};
  for (int y = std::min(from[1], to[1]); y <= std::max(from[1], to[1]); ++y)
    for (int x = std::min(from[0], to[0]); x <= std::max(from[0], to[0]); ++x)
      nearest = hitFurniture(ray, x, y, nearest);
  return nearest;
}

}  // namespace

double GeneratedBuilding::area() const { return rooms_x * kPitch_m * rooms_y * kPitch_m; }

GeneratedBuilding buildingOf(double area_m2) {
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(area_m2) / kPitch_m)));
  return {side, side};
}

RangeImage seenIn(const GeneratedBuilding& building, const CameraPlace& place) {
  constexpr double kFocal_pixels = 277.0;
  const Eigen::Vector3d forward(std::cos(place.yaw_rad), std::sin(place.yaw_rad), 0.0);
  const Eigen::Vector3d right(forward.y(), -forward.x(), 0.0);
  const Eigen::Vector3d position(place.x_m, place.y_m, kCameraHeight_m);
  RangeImage image;
  image.camera = {320, 240, kFocal_pixels, kFocal_pixels, 159.5, 119.5};
  image.T_map_camera.matrix().col(0).head<3>() = right;
  image.T_map_camera.matrix().col(1).head<3>() = -Eigen::Vector3d::UnitZ();
  image.T_map_camera.matrix().col(2).head<3>() = forward;
  image.T_map_camera.translation() = position;
  image.origin = toPoint3f(position);
  const auto pixels = static_cast<std::size_t>(image.camera.width * image.camera.height);
  image.ends.resize(pixels);
  image.kinds.assign(pixels, RayEnd::kNone);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto u = static_cast<double>(i % static_cast<std::size_t>(image.camera.width));
    const auto v = static_cast<double>(i / static_cast<std::size_t>(image.camera.width));
    const Eigen::Vector3d direction =
        image.T_map_camera.linear() * Eigen::Vector3d((u - image.camera.cx) / kFocal_pixels,
                                                      (v - image.camera.cy) / kFocal_pixels, 1.0);
    // Just behind the surface, so that the end lies in the solid voxel.
    const double depth_m = hit(building, {{position.x(), position.y(), position.z()},
                                          {direction.x(), direction.y(), direction.z()}}) +
                           0.001;
    if (depth_m >= kFarthest_m) continue;
    image.ends[i] = toPoint3f(position + depth_m * direction);
    image.kinds[i] = RayEnd::kHit;
    ++image.hits;
  }
  return image;
}

void explore(const GeneratedBuilding& building, int unexplored_rooms, OccupancyMap& map,
             RowEnd end) {
  constexpr int kFramesUntilClamped = 6;
  // The map offers frames alone as its way in; filling it by those would take hours.
  auto& tree = static_cast<VoxelTree&>(const_cast<octomap::OcTree&>(map.tree()));
  SettledVoxels settled;
  Workers alone(1);
  std::map<int, std::vector<RoomBlock>> blocks_of_kind;
  for (int y = 0; y < building.rooms_y; ++y) {
    for (int x = 0; x < building.rooms_x; ++x) {
      const int from_end = end == RowEnd::kWest ? x : building.rooms_x - 1 - x;
      if (y + 1 == building.rooms_y && from_end < unexplored_rooms) continue;
      const RoomKind kind = kindOf(building, x, y);
      std::vector<RoomBlock>& blocks = blocks_of_kind[kind.number()];
      if (blocks.empty()) blocks = blocksOf(kind);
      const std::vector<VoxelBlock> frame = placed(blocks, x, y);
      for (int i = 0; i < kFramesUntilClamped; ++i) (void)tree.integrate(frame, settled, alone);
    }
  }
}

std::vector<CameraPlace> drive(const GeneratedBuilding& building, int first_row, double length_m,
                               double step_m) {
  constexpr double kSwing_rad = 1.0;
  constexpr double kSwingPeriod_m = 3.0;
  const double door_m = 0.5 * (kDoor.bottom + kDoor.top) * kResolution_m;
  const double row_m = (building.rooms_x - 1) * kPitch_m;
  std::vector<CameraPlace> places;
  const auto steps = static_cast<int>(std::lround(length_m / step_m));
  for (int i = 0; i < steps; ++i) {
    const double way_m = i * step_m;
    const int leg = static_cast<int>(way_m / (row_m + kPitch_m));
    const double on_leg_m = way_m - leg * (row_m + kPitch_m);
    const bool eastward = leg % 2 == 0;
    const double along_m = std::min(on_leg_m, row_m);
    const bool to_next_row = on_leg_m > row_m;
    const int row = (first_row + leg) % building.rooms_y;
    const double heading_rad = to_next_row ? M_PI / 2 : eastward ? 0.0 : M_PI;
    places.push_back({door_m + (eastward ? along_m : row_m - along_m),
                      door_m + row * kPitch_m + std::max(0.0, on_leg_m - row_m),
                      heading_rad + kSwing_rad * std::sin(2.0 * M_PI * way_m / kSwingPeriod_m)});
  }
  return places;
}

}  // namespace occusg
