// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Everything most programs need: `#include <occusg/occusg.hpp>`. Programs in examples/cpp/ of the
/// sources show how.

#include "occusg/error.hpp"
#include "occusg/geometry/polygon.hpp"
#include "occusg/geometry/polygon_overlap.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg/graph/scene_graph.hpp"
#include "occusg/io/map_reader.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/results.hpp"
#include "occusg/io/rooms_file.hpp"
#include "occusg/io/scene_graph_file.hpp"
#include "occusg/io/sequence_reader.hpp"
#include "occusg/io/session_folder.hpp"
#include "occusg/mapping/free_space_layer.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/perception/point_cloud.hpp"
#include "occusg/pipeline/config_file.hpp"
#include "occusg/pipeline/pipeline.hpp"
#include "occusg/regions/constriction_decomposer.hpp"
#include "occusg/regions/decomposer.hpp"
#include "occusg/regions/label_regions.hpp"
