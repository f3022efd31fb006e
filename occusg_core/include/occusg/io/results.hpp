// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "occusg/io/output_folder.hpp"
#include "occusg/io/rooms_file.hpp"
#include "occusg/pipeline/pipeline.hpp"

namespace occusg {

/// A file to be written: its plain name and its bytes.
struct ResultFile {
  std::string name;
  std::string bytes;
};

/// A storey and its layer.
struct StoreyLayer {
  Storey storey;
  const FreeSpace* layer = nullptr;  ///< Never null.
};

/// What a run has found, as its files show it.
struct Findings {
  const FreeSpace& free_space;
  const SceneGraph& graph;
  double floor_z_m = 0.0;
  std::string scene;
  std::vector<StoreyLayer> storeys = {};  ///< From the lowest up; empty where there is one alone.
};

/// The rooms the pipeline has now, with the doors between them.
[[nodiscard]] RoomsFile roomsOf(const Pipeline& pipeline, const std::string& scene);

/// `timing.json`: {stage: {count, mean_ms, std_ms, p50_ms, p95_ms, max_ms, memory_mib}}.
[[nodiscard]] std::string timingJson(const StageTimes& times);

/// Everything a run leaves behind but the 3D map: rooms, scene graph in our format, GraphML and
/// Spark-DSG's, GeoJSON, the free-space map as map_server reads it (in a building with several
/// storeys one more for each, free_space_<storey>.pgm), the overview picture, the timing.
[[nodiscard]] std::vector<ResultFile> resultFiles(const Findings& findings,
                                                  const StageTimes& times);
/// The same and the 3D map as OctoMap reads it.
[[nodiscard]] std::vector<ResultFile> resultFiles(const Pipeline& pipeline,
                                                  const std::string& scene,
                                                  const StageTimes& times);

/// A file to be written: its plain name and the function that writes its bytes.
struct ResultWriter {
  std::string name;
  std::function<void(std::ostream&)> write;
};

/// The files of `resultFiles`, made one at a time when they are written; the picture, which takes
/// longest and tells nothing the others do not, is the last.
/// @param findings and `times`, `pipeline` outlive the writers.
[[nodiscard]] std::vector<ResultWriter> resultWriters(const Findings& findings,
                                                      const StageTimes& times);
[[nodiscard]] std::vector<ResultWriter> resultWriters(const Pipeline& pipeline,
                                                      const std::string& scene,
                                                      const StageTimes& times);

/// Results have names that files of a saved session have too.
/// @throws Error naming the folder when it holds a session.
void checkResultsPlace(const std::string& folder);

/// Writes the files in their order, and the index of them (`result_index.hpp`) when all are there:
/// a folder whose index agrees with its files is of one run.
/// @throws Error as `OutputFolder::write`.
void writeResultFiles(const OutputFolder& folder, const std::vector<ResultWriter>& files);
void writeResultFiles(const OutputFolder& folder, const std::vector<ResultFile>& files);

}  // namespace occusg
