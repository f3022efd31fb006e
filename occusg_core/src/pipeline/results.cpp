// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/results.hpp"

#include <iomanip>
#include <locale>
#include <sstream>

#include "occusg/io/graphml_file.hpp"
#include "occusg/io/map_files.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/overview_picture.hpp"
#include "occusg/io/rooms_geojson.hpp"
#include "occusg/io/scene_graph_file.hpp"
#include "occusg/io/spark_dsg_file.hpp"

namespace occusg {
namespace {

constexpr double kBytesPerMebibyte = 1024.0 * 1024.0;

std::vector<Point2> trajectoryOf(const SceneGraph& graph) {
  std::vector<Point2> trajectory;
  for (const auto& [id, agent] : graph.nodes(NodeType::kAgent))
    trajectory.push_back(agent.groundPosition());
  return trajectory;
}

std::vector<ObjectRecord> objectsOf(const SceneGraph& graph) {
  std::vector<ObjectRecord> objects;
  for (const auto& [id, node] : graph.nodes(NodeType::kObject)) {
    const auto& object = std::get<ObjectAttributes>(node.attributes);
    if (object.box.isEmpty()) continue;
    const Eigen::Vector3d& low = object.box.min();
    const Eigen::Vector3d& high = object.box.max();
    objects.push_back({object.class_name, {{low.x(), low.y()}, {high.x(), high.y()}}});
  }
  return objects;
}

std::vector<RoomLink> linksOf(const SceneGraph& graph) {
  std::vector<RoomLink> links;
  for (const auto& [ends, edge] : graph.edges(EdgeType::kRoomAdjacency)) {
    for (const Segment2& crossing : edge.crossings)
      links.push_back({graph.at(ends.first).groundPosition(), midpoint(crossing),
                       graph.at(ends.second).groundPosition()});
  }
  return links;
}

std::string overviewPng(const Pipeline& pipeline, const RoomsFile& rooms) {
  const SceneGraph& graph = pipeline.graph();
  return encodePng(
      drawOverview(pipeline.freeSpace(), {rooms.scene, rooms.rooms, rooms.doors,
                                          trajectoryOf(graph), objectsOf(graph), linksOf(graph)}));
}

}  // namespace

RoomsFile roomsOf(const Pipeline& pipeline, const std::string& scene) {
  return roomsOf(pipeline.graph(), scene, pipeline.config().graph.rooms.floor_z_m);
}

std::string timingJson(const StageTimes& times) {
  std::ostringstream json;
  json.imbue(std::locale::classic());
  json << std::fixed << std::setprecision(4) << "{";
  for (const Stage stage : kStages) {
    const StageSummary summary = times.summary(stage);
    json << (stage == kStages.front() ? "\n" : ",\n") << " \"" << nameOf(stage)
         << "\": {\"count\": " << summary.count << ", \"mean_ms\": " << summary.mean_ms
         << ", \"std_ms\": " << summary.std_ms << ", \"p50_ms\": " << summary.p50_ms
         << ", \"p95_ms\": " << summary.p95_ms << ", \"max_ms\": " << summary.max_ms
         << ", \"memory_mib\": "
         << static_cast<double>(times.memoryBytes(stage)) / kBytesPerMebibyte << "}";
  }
  json << "\n}\n";
  return json.str();
}

std::vector<ResultFile> resultFiles(const Pipeline& pipeline, const std::string& scene,
                                    const StageTimes& times) {
  const RoomsFile rooms = roomsOf(pipeline, scene);
  const MapFiles map = toMapFiles(pipeline.freeSpace(), "free_space.pgm");
  return {{"rooms.json", toJson(rooms)},
          {"scene_graph.json", toJson(pipeline.graph(), scene)},
          {"scene_graph.graphml", toGraphMl(pipeline.graph(), scene)},
          {"scene_graph.dsg.json", toSparkDsg(pipeline.graph(), scene)},
          {"rooms.geojson", toGeoJson(rooms)},
          {"free_space.pgm", map.pgm},
          {"free_space.yaml", map.yaml},
          {"map.ot", toOctomap(pipeline.occupancyMap().tree(), OctomapEncoding::kFull)},
          {"overview.png", overviewPng(pipeline, rooms)},
          {"timing.json", timingJson(times)}};
}

}  // namespace occusg
