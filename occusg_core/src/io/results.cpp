// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/results.hpp"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <locale>
#include <map>
#include <ostream>
#include <sstream>

#include "io/file_bytes.hpp"
#include "io/findings_picture.hpp"
#include "io/graphml_file.hpp"
#include "io/result_index.hpp"
#include "io/rooms_geojson.hpp"
#include "io/session_parts.hpp"
#include "io/spark_dsg_file.hpp"
#include "mapping/ceiling.hpp"
#include "occusg/error.hpp"
#include "occusg/io/map_files.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/scene_graph_file.hpp"

namespace occusg {
namespace {

constexpr double kBytesPerMebibyte = 1024.0 * 1024.0;

std::vector<StoreyLayer> storeysOf(const Pipeline& pipeline) {
  const std::vector<Storey>& storeys = pipeline.storeys();
  std::vector<StoreyLayer> layers;
  if (storeys.size() == 1) return layers;
  for (std::size_t i = 0; i < storeys.size(); ++i)
    layers.push_back({storeys[i], &pipeline.freeSpace(i)});
  std::sort(layers.begin(), layers.end(), [](const StoreyLayer& a, const StoreyLayer& b) {
    return a.storey.floor_z_m < b.storey.floor_z_m;
  });
  return layers;
}

Findings findingsOf(const Pipeline& pipeline, const std::string& scene) {
  return {pipeline.freeSpace(), pipeline.graph(), pipeline.config().graph.rooms.floor_z_m, scene,
          storeysOf(pipeline)};
}

RoomsFile roomsOf(const Findings& found) {
  RoomsFile file = roomsOf(found.graph, found.scene, found.floor_z_m);
  for (const StoreyLayer& storey : found.storeys) {
    file.storeys.push_back({storey.storey.id, storey.storey.floor_z_m,
                            ceilingOf(*storey.layer, storey.storey.floor_z_m)});
  }
  if (!file.storeys.empty()) file.floor_z_m = file.storeys.front().floor_z_m;
  return file;
}

}  // namespace

RoomsFile roomsOf(const Pipeline& pipeline, const std::string& scene) {
  return roomsOf(findingsOf(pipeline, scene));
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

namespace {

std::vector<ResultFile> bytesOf(const std::vector<ResultWriter>& writers) {
  std::vector<ResultFile> files;
  for (const ResultWriter& writer : writers) {
    std::ostringstream bytes;
    writer.write(bytes);
    files.push_back({writer.name, bytes.str()});
  }
  return files;
}

/// By value: the findings hold references to what outlives the writers.
std::vector<ResultWriter> writersOf(const Findings& found, const StageTimes& times) {
  const auto rooms = [found] { return roomsOf(found); };
  const auto map = [found] { return toMapFiles(found.free_space, "free_space.pgm"); };
  std::vector<ResultWriter> writers = {
      {"rooms.json", [rooms](std::ostream& out) { out << toJson(rooms()); }},
      {"scene_graph.json",
       [found](std::ostream& out) { writeJson(found.graph, found.scene, "map", out); }},
      {"scene_graph.graphml",
       [found](std::ostream& out) { writeGraphMl(found.graph, found.scene, out); }},
      {"scene_graph.dsg.json",
       [found](std::ostream& out) { writeSparkDsg(found.graph, found.scene, "map", out); }},
      {"rooms.geojson", [rooms](std::ostream& out) { out << toGeoJson(rooms()); }},
      {"free_space.pgm", [map](std::ostream& out) { out << map().pgm; }},
      {"free_space.yaml", [map](std::ostream& out) { out << map().yaml; }},
      {"timing.json", [&times](std::ostream& out) { out << timingJson(times); }}};
  for (const StoreyLayer& storey : found.storeys) {
    const std::string name = "free_space_" + std::to_string(storey.storey.id);
    const auto files = [name, layer = storey.layer] { return toMapFiles(*layer, name + ".pgm"); };
    writers.push_back({name + ".pgm", [files](std::ostream& out) { out << files().pgm; }});
    writers.push_back({name + ".yaml", [files](std::ostream& out) { out << files().yaml; }});
  }
  return writers;
}

ResultWriter pictureOf(const Findings& found, const std::string& scene) {
  return {"overview.png",
          [found, scene](std::ostream& out) { out << overviewPng(found, roomsOf(found)); }};
}

}  // namespace

std::vector<ResultWriter> resultWriters(const Findings& findings, const StageTimes& times) {
  std::vector<ResultWriter> writers = writersOf(findings, times);
  writers.push_back(pictureOf(findings, findings.scene));
  return writers;
}

std::vector<ResultWriter> resultWriters(const Pipeline& pipeline, const std::string& scene,
                                        const StageTimes& times) {
  const Findings findings = findingsOf(pipeline, scene);
  std::vector<ResultWriter> writers = writersOf(findings, times);
  writers.push_back({"map.ot", [&pipeline](std::ostream& out) {
                       writeOctomap(pipeline.occupancyMap().tree(), OctomapEncoding::kFull, out);
                     }});
  writers.push_back(pictureOf(findings, scene));
  return writers;
}

std::vector<ResultFile> resultFiles(const Findings& findings, const StageTimes& times) {
  return bytesOf(resultWriters(findings, times));
}

std::vector<ResultFile> resultFiles(const Pipeline& pipeline, const std::string& scene,
                                    const StageTimes& times) {
  return bytesOf(resultWriters(pipeline, scene, times));
}

void checkResultsPlace(const std::string& folder) {
  constexpr std::size_t kBeginning = 256;  // where a session says what it is
  const std::filesystem::path index = std::filesystem::path(folder) / kSessionFile;
  std::error_code failed;
  if (!std::filesystem::is_regular_file(index, failed)) return;
  if (readBeginning(index.string(), kBeginning).find("\"occusg-session\"") == std::string::npos)
    return;
  throw refuse(folder, "holds a saved session, whose map and scene graph the results would replace",
               "another folder is needed for the results");
}

void writeResultFiles(const OutputFolder& folder, const std::vector<ResultWriter>& files) {
  std::map<std::string, FileMark> marks;
  for (const ResultWriter& file : files) marks[file.name] = folder.write(file.name, file.write);
  folder.write(kResultIndexFile, toResultIndex(marks));
}

void writeResultFiles(const OutputFolder& folder, const std::vector<ResultFile>& files) {
  std::vector<ResultWriter> writers;
  writers.reserve(files.size());
  for (const ResultFile& file : files)
    writers.push_back({file.name, [&file](std::ostream& out) { out << file.bytes; }});
  writeResultFiles(folder, writers);
}

}  // namespace occusg
