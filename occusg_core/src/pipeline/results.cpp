// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/results.hpp"

#include <iomanip>
#include <locale>
#include <map>
#include <sstream>

#include "occusg/io/graphml_file.hpp"
#include "occusg/io/map_files.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/overview_picture.hpp"
#include "occusg/io/result_index.hpp"
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

std::vector<DrawnObject> objectsOf(const SceneGraph& graph) {
  std::vector<DrawnObject> objects;
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
    for (const Segment2& crossing : edge.crossings) {
      links.push_back({graph.at(ends.first).groundPosition(), midpoint(crossing),
                       graph.at(ends.second).groundPosition()});
    }
  }
  return links;
}

std::string overviewPng(const Findings& findings, const RoomsFile& rooms) {
  const SceneGraph& graph = findings.graph;
  return encodePng(
      drawOverview(findings.free_space, {rooms.scene, rooms.rooms, rooms.doors, trajectoryOf(graph),
                                         objectsOf(graph), linksOf(graph)}));
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

std::vector<ResultFile> resultFiles(const Findings& findings, const StageTimes& times) {
  const std::string& scene = findings.scene;
  const RoomsFile rooms = roomsOf(findings.graph, scene, findings.floor_z_m);
  const MapFiles map = toMapFiles(findings.free_space, "free_space.pgm");
  return {{"rooms.json", toJson(rooms)},
          {"scene_graph.json", toJson(findings.graph, scene)},
          {"scene_graph.graphml", toGraphMl(findings.graph, scene)},
          {"scene_graph.dsg.json", toSparkDsg(findings.graph, scene)},
          {"rooms.geojson", toGeoJson(rooms)},
          {"free_space.pgm", map.pgm},
          {"free_space.yaml", map.yaml},
          {"timing.json", timingJson(times)},
          {"overview.png", overviewPng(findings, rooms)}};
}

std::vector<ResultFile> resultFiles(const Pipeline& pipeline, const std::string& scene,
                                    const StageTimes& times) {
  std::vector<ResultFile> files = resultFiles(
      {pipeline.freeSpace(), pipeline.graph(), pipeline.config().graph.rooms.floor_z_m, scene},
      times);
  files.push_back({"map.ot", toOctomap(pipeline.occupancyMap().tree(), OctomapEncoding::kFull)});
  return files;
}

void writeResultFiles(const OutputFolder& folder, const std::vector<ResultFile>& files) {
  std::map<std::string, FileMark> marks;
  for (const ResultFile& file : files) {
    folder.write(file.name, file.bytes);
    marks[file.name] = markOf(file.bytes);
  }
  folder.write(kResultIndexFile, toResultIndex(marks));
}

}  // namespace occusg
