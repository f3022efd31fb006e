// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "mapping/voxel_columns.hpp"
#include "occusg/io/sequence_reader.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/perception/depth_projector.hpp"

namespace occusg {
namespace {

TEST(FreeSpaceOfARecording, UpdatesEqualRecomputeOnEveryFrame) {
  const SequenceReader sequence(OCCUSG_EXAMPLES "/apartment");
  OccupancyMapConfig map_config;
  map_config.resolution_m = 0.1;
  const GridFrame frame{map_config.resolution_m};
  DepthProjectorConfig depth;
  depth.stride = 4;
  DepthProjector projector(depth);
  OccupancyMap map(map_config);
  FreeSpaceLayer updated({}, frame);
  FreeSpaceLayer oracle({}, frame);
  FreeSpaceLayerConfig by_floor;
  by_floor.height_reference = HeightReference::kLocalFloor;
  by_floor.lowest_z_m = 0.1;
  by_floor.highest_z_m = 1.5;
  FreeSpaceLayer updated_by_floor(by_floor, frame);
  FreeSpaceLayer oracle_by_floor(by_floor, frame);

  ASSERT_GT(sequence.size(), 100U);
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    const Frame seen = sequence.read(i);
    const MapChange change =
        map.insert(projector.project(seen.depth, seen.camera, seen.T_map_camera));
    const FreeSpace& by_update = updated.update(map, change);
    const FreeSpace& from_scratch = oracle.recompute(map);
    ASSERT_TRUE(by_update.cells == from_scratch.cells);
    ASSERT_TRUE(by_update.evidence == from_scratch.evidence);
    ASSERT_EQ(by_update.changed, from_scratch.changed);
    (void)updated_by_floor.update(map, change);
    (void)oracle_by_floor.recompute(map);
    ASSERT_TRUE(updated_by_floor.freeSpace().cells == oracle_by_floor.freeSpace().cells);
  }
  EXPECT_TRUE(map.columns() == VoxelColumns::of(map.tree()));
}

}  // namespace
}  // namespace occusg
