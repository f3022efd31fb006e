// SPDX-License-Identifier: BSD-3-Clause
#include "perception/euclidean_cluster.hpp"

#include <pcl/PointIndices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
// The template itself: PCL's segmentation library, which has it ready-made, brings VTK along.
#include <cmath>
#include <cstdint>
#include <pcl/segmentation/impl/extract_clusters.hpp>
#include <unordered_map>

namespace occusg {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// Points of two voxels that share a face are then at most sqrt(6) / 2.5 = 0.98 eps apart.
constexpr double kVoxelsPerEps = 2.5;

struct Voxel {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
  friend bool operator==(const Voxel& a, const Voxel& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

struct VoxelHash {
  std::size_t operator()(const Voxel& voxel) const {
    // Odd multipliers of 64 bits spread neighbouring voxels.
    const auto mixed = static_cast<std::uint64_t>(voxel.x) * 0x9E3779B97F4A7C15ULL ^
                       static_cast<std::uint64_t>(voxel.y) * 0xC2B2AE3D27D4EB4FULL ^
                       static_cast<std::uint64_t>(voxel.z) * 0x165667B19E3779F9ULL;
    return static_cast<std::size_t>(mixed ^ (mixed >> 32U));
  }
};

/// One point for each occupied voxel, in the order in which the points meet the voxels.
struct ThinnedPoints {
  Cloud::Ptr cloud{new Cloud};
  std::vector<std::size_t> voxel_of_point;
  std::vector<std::size_t> points_in_voxel;
};

ThinnedPoints thinned(const std::vector<Eigen::Vector3d>& points, double voxel_m) {
  ThinnedPoints result;
  result.voxel_of_point.reserve(points.size());
  std::unordered_map<Voxel, std::size_t, VoxelHash> index;
  index.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d scaled = (point / voxel_m).array().floor();
    const Voxel voxel{static_cast<std::int64_t>(scaled.x()), static_cast<std::int64_t>(scaled.y()),
                      static_cast<std::int64_t>(scaled.z())};
    const auto [entry, is_new] = index.emplace(voxel, index.size());
    if (is_new) {
      // A point of the scene, not a mean: means could lie nearer to another set than any point.
      const Eigen::Vector3f single = point.cast<float>();
      result.cloud->push_back(pcl::PointXYZ(single.x(), single.y(), single.z()));
      result.points_in_voxel.push_back(0);
    }
    ++result.points_in_voxel[entry->second];
    result.voxel_of_point.push_back(entry->second);
  }
  return result;
}

std::vector<pcl::PointIndices> clustersOf(const Cloud::Ptr& cloud, double eps_m) {
  // Sorting the neighbours takes longer than finding them, and clustering does not need it.
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>(false));
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(eps_m);
  extraction.setMinClusterSize(1);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  return clusters;
}

}  // namespace

std::vector<std::size_t> largestCluster(const std::vector<Eigen::Vector3d>& points, double eps_m) {
  if (points.empty()) return {};
  const ThinnedPoints thin = thinned(points, eps_m / kVoxelsPerEps);

  constexpr std::size_t kNone = 0;
  std::vector<std::size_t> cluster_of_voxel(thin.points_in_voxel.size(), kNone);
  std::size_t best = kNone;
  std::size_t best_count = 0;
  int best_first = 0;
  std::size_t number = kNone;
  for (const pcl::PointIndices& cluster : clustersOf(thin.cloud, eps_m)) {
    ++number;
    std::size_t count = 0;
    for (const int voxel : cluster.indices) {
      cluster_of_voxel[static_cast<std::size_t>(voxel)] = number;
      count += thin.points_in_voxel[static_cast<std::size_t>(voxel)];
    }
    const int first = cluster.indices.front();
    if (count < best_count || (count == best_count && first > best_first)) continue;
    best = number;
    best_count = count;
    best_first = first;
  }

  std::vector<std::size_t> members;
  members.reserve(best_count);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (cluster_of_voxel[thin.voxel_of_point[i]] == best) members.push_back(i);
  return members;
}

}  // namespace occusg
