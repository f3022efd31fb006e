// SPDX-License-Identifier: BSD-3-Clause
// How far the maps of the three integration modes are from OctoMap's own insertPointCloud on the
// same points, over recordings given as arguments and over the generated deep building.
#include <octomap/octomap.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "deep_building.hpp"
#include "map_difference.hpp"
#include "occusg/error.hpp"
#include "occusg/io/sequence_reader.hpp"
#include "occusg/perception/depth_projector.hpp"

namespace occusg {
namespace {

constexpr std::size_t kDeepFrames = 120;
constexpr int kStride = 2;

using FrameSource = std::function<DepthFrame(std::size_t)>;

const char* nameOf(IntegrationMode mode) {
  if (mode == IntegrationMode::kReference) return "reference";
  return mode == IntegrationMode::kExact ? "exact" : "fast";
}

void compare(const std::string& scene, std::size_t frames, double max_depth_m,
             const FrameSource& frameAt) {
  DepthProjector projector({kStride, 0.01, max_depth_m, BeyondMaxDepth::kDrop});
  std::vector<OccupancyMap> maps;
  for (const IntegrationMode mode :
       {IntegrationMode::kReference, IntegrationMode::kExact, IntegrationMode::kFast}) {
    OccupancyMapConfig config;
    config.mode = mode;
    maps.emplace_back(config);
  }
  octomap::OcTree tree = testing::emptyTreeLike(OccupancyMapConfig{});
  std::size_t ignored = 0;
  for (std::size_t i = 0; i < frames; ++i) {
    const DepthFrame frame = frameAt(i);
    const RangeImage& image =
        projector.projectLattice(frame.depth, frame.camera, frame.T_map_camera);
    for (OccupancyMap& map : maps) ignored += map.insert(image).ignored() ? 1 : 0;
    const octomap::point3d origin(image.origin.x, image.origin.y, image.origin.z);
    tree.insertPointCloud(testing::toOctomapCloud(toPointCloud(image)), origin,
                          OccupancyMapConfig{}.max_range_m, false, false);
  }
  for (const OccupancyMap& map : maps) {
    const testing::MapDifference d = testing::differenceOf(map.tree(), tree);
    std::printf("| %s | %zu | %s | %s | %zu | %.4f %% | %.4f %% | %.3f %% | %.6f | %zu |\n",
                scene.c_str(), frames, nameOf(map.config().mode), map.tree() == tree ? "yes" : "no",
                d.known, 100.0 * d.missingShare(), 100.0 * d.extraShare(), 100.0 * d.sameShare(),
                d.occupiedIou(), d.lost_occupied);
  }
  if (ignored > 0) std::printf("%s: %zu insertions were ignored\n", scene.c_str(), ignored);
  std::fflush(stdout);
}

void compareRecording(const std::string& folder) {
  const SequenceReader sequence(folder);
  compare(sequence.scene(), sequence.size(), 10.0, [&](std::size_t i) { return sequence.read(i); });
}

}  // namespace
}  // namespace occusg

int main(int argc, char** argv) {
  try {
    std::printf(
        "| scene | frames | mode | equal | voxels | missing | extra | same | occupied IoU | "
        "occupied lost |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
    for (int i = 1; i < argc; ++i) occusg::compareRecording(argv[i]);
    const occusg::testing::BoxWorld world = occusg::testing::deepBuilding();
    occusg::compare("deep building", occusg::kDeepFrames, 65.0, [&](std::size_t i) {
      return occusg::testing::deepFrame(world, 3 * i, occusg::kStride);
    });
  } catch (const occusg::Error& error) {
    std::fprintf(stderr, "integration_accuracy: %s\n", error.what());
    return 1;
  }
  return 0;
}
