// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "box_world.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/scene_graph_file.hpp"
#include "occusg/pipeline/pipeline.hpp"

namespace occusg {
namespace {

using testing::driveThroughTwoRooms;

/// The drive, with frames put in after the fifth: the sixth, moved.
Pipeline drivenWith(const std::vector<Eigen::Vector3d>& jumps, const PipelineConfig& config = {}) {
  Pipeline pipeline(config);
  const auto frames = driveThroughTwoRooms();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    pipeline.process(frames[i]);
    for (std::size_t j = 0; i == 5 && j < jumps.size(); ++j) {
      DepthFrame moved = frames[5];
      moved.T_map_camera.translation() += jumps[j];
      moved.stamp_s += 0.01 * static_cast<double>(j + 1);
      pipeline.process(moved);
    }
  }
  pipeline.finish();
  return pipeline;
}

std::string mapOf(const Pipeline& pipeline) {
  return toOctomap(pipeline.occupancyMap().tree(), OctomapEncoding::kFull);
}

TEST(MisplacedFrames, LeaveNothingInMapAndGraph) {
  const Pipeline undisturbed = drivenWith({});
  const Eigen::Vector3d utm(691'000.0, 5'334'000.0, 0.0);
  const std::vector<std::vector<Eigen::Vector3d>> cases = {
      {{30.0, 0.0, 0.0}},                          // one pose that jumped
      {{900.0, 900.0, 0.0}, {900.0, 900.0, 0.0}},  // twice at one place: too far for the layer
      {utm, utm},                                  // beyond the map and beyond a graph
  };
  for (const auto& jumps : cases) {
    const Pipeline disturbed = drivenWith(jumps);
    EXPECT_EQ(disturbed.counts().framesMisplaced(), jumps.size());
    EXPECT_TRUE(mapOf(disturbed) == mapOf(undisturbed));
    EXPECT_TRUE(toJson(disturbed.graph(), "") == toJson(undisturbed.graph(), ""));
  }
}

TEST(MisplacedFrames, AreCountedByReason) {
  const Eigen::Vector3d far(900.0, 900.0, 0.0);
  const Eigen::Vector3d outside(1e4, 0.0, 0.0);
  const PipelineCounts counts = drivenWith({far, far, outside, outside}).counts();
  EXPECT_EQ(counts.frames_too_fast, 2U);
  EXPECT_EQ(counts.frames_beyond_span, 1U);
  EXPECT_EQ(counts.frames_outside_map, 1U);
}

}  // namespace
}  // namespace occusg
