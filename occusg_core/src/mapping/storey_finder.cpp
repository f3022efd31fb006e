// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/storey_finder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "mapping/voxel_columns.hpp"

namespace occusg {
namespace {

/// How far the robot moves, or how many frames it takes, before its level is looked at again.
constexpr double kStep_m = 0.2;
constexpr std::size_t kFramesOnTheSpot = 8;
/// Columns within this distance are looked at, one in this spacing.
constexpr double kReach_m = 2.5;
constexpr double kSpacing_m = 0.15;
/// A floor lies so far below a sensor, whether a robot or a person carries it.
constexpr double kHighestSensor_m = 2.5;
constexpr double kLowestSensor_m = 0.1;
/// By so much the height of a sensor above the floor varies.
constexpr double kSensorSway_m = 0.5;
/// What is free above a floor.
constexpr double kHeadroom_m = 0.5;
/// Two floors of one storey differ by at most this: a few steps, or the drift of a pose.
constexpr double kSameStorey_m = 0.8;
constexpr double kLeastFloor_m2 = 4.0;
constexpr double kLeastPath_m = 2.0;
/// No landing is so large that it needs no path.
constexpr double kAmpleFloor_m2 = 8.0;
constexpr std::size_t kLeastLooks = 3;
/// No building has more; poses that climb for ever do not fill the memory.
constexpr std::size_t kMostStoreys = 200;
/// Older heights of the sensor fade after so many.
constexpr std::size_t kRememberedHeights = 100;
/// A height that differs by more was taken on the way to another storey.
constexpr double kHeightNoise_m = 0.25;

/// Feet at most so far above or below a floor stand on it.
constexpr double kOnFloor_m = 0.3;
/// Two passages whose ends are nearer than this are the same one.
constexpr double kSamePassage_m = 1.5;
/// A passage that gets less far along is a lift.
constexpr double kLiftRun_m = 1.0;
/// A steeper passage has treads.
constexpr double kSteepestRamp = 0.25;
/// A way off all floors that takes more looks, as a drift of the poses makes it, is no stair.
constexpr std::size_t kLongestTrail = 2000;
/// Feet that move farther between two looks were carried there.
constexpr double kLongestStep_m = 2.0;
/// Treads are looked for so far to the sides of the feet.
constexpr double kHalfStairs_m = 0.45;
constexpr double kLeastTread_m2 = 0.06;
constexpr double kLowestRiser_m = 0.12;

/// How many heights stand out, at least so far apart, with at least so many columns.
int peaksIn(const std::vector<std::size_t>& columns_at, double apart, double least) {
  int peaks = 0;
  std::optional<std::size_t> last;
  for (std::size_t height = 0; height < columns_at.size(); ++height) {
    const std::size_t columns = columns_at[height];
    const std::size_t below = height == 0 ? 0 : columns_at[height - 1];
    const std::size_t above = height + 1 == columns_at.size() ? 0 : columns_at[height + 1];
    const bool is_peak =
        static_cast<double>(columns) >= least && columns > below && columns >= above;
    if (!is_peak || (last && static_cast<double>(height - *last) < apart)) continue;
    last = height;
    ++peaks;
  }
  return peaks;
}

/// Horizontal length of a path [m].
double runOf(const std::vector<Eigen::Vector3d>& path) {
  double run_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) run_m += (path[i] - path[i - 1]).head<2>().norm();
  return run_m;
}

StairsKind kindOf(const std::vector<Eigen::Vector3d>& path) {
  const double run_m = runOf(path);
  if (run_m < kLiftRun_m) return StairsKind::kLift;
  const double rise_m = path.back().z() - path.front().z();
  return rise_m > kSteepestRamp * run_m ? StairsKind::kStairs : StairsKind::kRamp;
}

bool areNear(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - b).norm() <= kSamePassage_m;
}

/// Calls `visit` with the height of every floor of `column` between the heights.
template <typename Visit>
void forEachFloor(const ColumnBits& column, const VoxelRun& heights, int headroom,
                  const Visit& visit) {
  for (VoxelRun run = column.nextFree(heights.bottom); !run.empty();
       run = column.nextFree(run.top)) {
    if (run.bottom >= heights.top) return;
    const bool stands_on_something = column.occupiedIn({run.bottom - 1, run.bottom}) == 1;
    if (stands_on_something && run.length() >= headroom) visit(run.bottom);
  }
}

}  // namespace

bool StoreyFinder::observe(const VoxelColumns& columns, const Eigen::Vector3d& position) {
  ++frames_on_the_spot_;
  const bool has_moved = !last_position_ || (position - *last_position_).norm() >= kStep_m;
  if (!has_moved && frames_on_the_spot_ < kFramesOnTheSpot) return false;
  last_position_ = position;
  frames_on_the_spot_ = 0;
  const std::optional<Level> level = levelNear(columns, position);
  if (!level) {
    followFeet(columns, position);
    return false;
  }
  bool is_new = false;
  if (const std::optional<std::size_t> storey = storeyAt(level->z_m)) {
    standOn(*storey, *level, position.z());
  } else if (isStorey(*level, position)) {
    add(level->z_m);
    standOn(building_.storeys.size() - 1, *level, position.z());
    is_new = true;
  }
  followFeet(columns, position);
  return is_new;
}

std::optional<StoreyFinder::Level> StoreyFinder::levelNear(const VoxelColumns& columns,
                                                           const Eigen::Vector3d& position) {
  const bool height_is_known = !building_.storeys.empty();
  const double lowest_m =
      height_is_known ? building_.sensor_height_m + kSensorSway_m : kHighestSensor_m;
  const double highest_m =
      height_is_known ? std::max(kLowestSensor_m, building_.sensor_height_m - kSensorSway_m)
                      : kLowestSensor_m;
  const VoxelRun heights{static_cast<int>(std::floor((position.z() - lowest_m) / resolution_m_)),
                         static_cast<int>(std::ceil((position.z() - highest_m) / resolution_m_))};
  const int headroom = static_cast<int>(std::ceil(kHeadroom_m / resolution_m_));
  const GridFrame frame{resolution_m_};
  std::map<int, std::size_t> columns_at;
  const int steps = static_cast<int>(kReach_m / kSpacing_m);
  for (int j = -steps; j <= steps; ++j) {
    for (int i = -steps; i <= steps; ++i) {
      if (i * i + j * j > steps * steps) continue;
      columns.read(
          frame.cellAt(Point2{position.x() + i * kSpacing_m, position.y() + j * kSpacing_m}),
          bits_);
      forEachFloor(bits_, heights, headroom, [&](int height) { ++columns_at[height]; });
    }
  }
  std::optional<Level> best;
  for (const auto& [height, count] : columns_at) {
    const auto above = columns_at.find(height + 1);
    const std::size_t both = count + (above == columns_at.end() ? 0 : above->second);
    const double area_m2 = static_cast<double>(both) * kSpacing_m * kSpacing_m;
    const int most = above != columns_at.end() && above->second > count ? height + 1 : height;
    if (!best || area_m2 > best->area_m2) best = Level{most * resolution_m_, area_m2};
  }
  return best;
}

std::optional<std::size_t> StoreyFinder::storeyAt(double z_m) const {
  const auto nearest = std::min_element(
      building_.storeys.begin(), building_.storeys.end(), [z_m](const Storey& a, const Storey& b) {
        return std::abs(a.floor_z_m - z_m) < std::abs(b.floor_z_m - z_m);
      });
  if (nearest == building_.storeys.end() || std::abs(nearest->floor_z_m - z_m) > kSameStorey_m)
    return std::nullopt;
  return static_cast<std::size_t>(nearest - building_.storeys.begin());
}

void StoreyFinder::standOn(std::size_t storey, const Level& level, double sensor_z_m) {
  building_.current = storey;
  candidate_.reset();
  const double height_m = sensor_z_m - level.z_m;
  const bool is_usual =
      heights_ == 0 || std::abs(height_m - building_.sensor_height_m) <= kHeightNoise_m;
  if (level.area_m2 < kLeastFloor_m2 || !is_usual) return;
  heights_ = std::min(heights_ + 1, kRememberedHeights);
  building_.sensor_height_m +=
      (height_m - building_.sensor_height_m) / static_cast<double>(heights_);
}

void StoreyFinder::followFeet(const VoxelColumns& columns, const Eigen::Vector3d& position) {
  if (building_.storeys.empty() || heights_ == 0) return;
  const Eigen::Vector3d feet = position - building_.sensor_height_m * Eigen::Vector3d::UnitZ();
  const bool was_carried =
      !trail_.empty() && (feet - trail_.back()).head<2>().norm() > kLongestStep_m;
  if (was_carried || trail_.size() >= kLongestTrail) {
    trail_.clear();
    stood_on_.reset();
  }
  trail_.push_back(feet);
  if (std::abs(feet.z() - building_.storeys[building_.current].floor_z_m) > kOnFloor_m) return;
  if (stood_on_ && *stood_on_ != building_.current)
    addPassage(columns, *stood_on_, building_.current);
  stood_on_ = building_.current;
  trail_.assign(1, feet);
}

/// The trail led from the one storey to the other.
void StoreyFinder::addPassage(const VoxelColumns& columns, std::size_t from, std::size_t to) {
  const double floor_m = building_.storeys[to].floor_z_m;
  const auto arrival =
      std::find_if(trail_.begin(), trail_.end(), [floor_m](const Eigen::Vector3d& feet) {
        return std::abs(feet.z() - floor_m) <= kOnFloor_m;
      });
  StoreyPassage passage;
  passage.path.assign(trail_.begin(), arrival == trail_.end() ? arrival : std::next(arrival));
  std::size_t lower = from;
  std::size_t upper = to;
  if (building_.storeys[from].floor_z_m > building_.storeys[to].floor_z_m) {
    std::swap(lower, upper);
    std::reverse(passage.path.begin(), passage.path.end());
  }
  passage.lower_storey = building_.storeys[lower].id;
  passage.upper_storey = building_.storeys[upper].id;
  const bool is_known = std::any_of(building_.passages.begin(), building_.passages.end(),
                                    [&passage](const StoreyPassage& known) {
                                      return known.lower_storey == passage.lower_storey &&
                                             known.upper_storey == passage.upper_storey &&
                                             areNear(known.path.front(), passage.path.front()) &&
                                             areNear(known.path.back(), passage.path.back());
                                    });
  if (is_known) return;
  passage.kind = kindOf(passage.path);
  if (passage.kind == StairsKind::kStairs) passage.risers = risersAlong(columns, passage.path);
  building_.passages.push_back(std::move(passage));
}

/// Counts the treads near a path, by the heights at which many columns show one; the upper floor
/// counts as the last.
int StoreyFinder::risersAlong(const VoxelColumns& columns,
                              const std::vector<Eigen::Vector3d>& path) {
  const GridFrame frame{resolution_m_};
  const int reach = static_cast<int>(std::ceil(kHalfStairs_m / resolution_m_));
  std::set<Cell> cells;
  for (const Eigen::Vector3d& feet : path) {
    const Cell middle = frame.cellAt(Point2{feet.x(), feet.y()});
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) cells.insert({middle.x + x, middle.y + y});
  }
  const auto heightOf = [this](const Eigen::Vector3d& feet) {
    return static_cast<int>(std::lround(feet.z() / resolution_m_));
  };
  const VoxelRun between{heightOf(path.front()) + 2, heightOf(path.back()) + 3};
  std::vector<std::size_t> columns_at(static_cast<std::size_t>(between.length()) + 1, 0);
  for (const Cell& cell : cells) {
    columns.read(cell, bits_);
    forEachFloor(bits_, between, 1, [&](int height) {
      ++columns_at[static_cast<std::size_t>(height - between.bottom)];
    });
  }
  return peaksIn(columns_at, kLowestRiser_m / resolution_m_,
                 kLeastTread_m2 / (resolution_m_ * resolution_m_));
}

bool StoreyFinder::isStorey(const Level& level, const Eigen::Vector3d& position) {
  if (level.area_m2 < kLeastFloor_m2) return false;
  if (building_.storeys.empty()) return true;
  if (building_.storeys.size() >= kMostStoreys) return false;
  if (!candidate_ || std::abs(candidate_->z_m - level.z_m) > 2.0 * resolution_m_)
    candidate_ = Candidate{level.z_m, 0, {}};
  ++candidate_->looks;
  candidate_->path.extend(position.head<2>());
  const bool is_ample =
      level.area_m2 >= kAmpleFloor_m2 || candidate_->path.diagonal().norm() >= kLeastPath_m;
  return candidate_->looks >= kLeastLooks && is_ample;
}

void StoreyFinder::add(double floor_z_m) {
  building_.storeys.push_back({static_cast<int>(building_.storeys.size()), floor_z_m, {}});
  divideHeights(building_.storeys);
}

void StoreyFinder::resumeFrom(const Building& building) {
  building_ = building;
  divideHeights(building_.storeys);
  heights_ = building.sensor_height_m > 0.0 ? kRememberedHeights : 0;
}

}  // namespace occusg
