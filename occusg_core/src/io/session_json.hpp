// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "io/file_mark.hpp"
#include "occusg/pipeline/building_pipeline.hpp"

namespace occusg {

/// Name of the file with the graph of a storey: "scene_graph.json" for the first, then
/// "scene_graph_1.json" and so on.
[[nodiscard]] std::string graphFileOf(std::size_t storey);

/// The text of a `session.json`: everything of the state but the nodes and edges of its graphs.
[[nodiscard]] std::string toSessionJson(const SessionState& state,
                                        const std::map<std::string, FileMark>& files);

struct SessionJson {
  std::map<std::string, FileMark> files;
  SessionState state;                                ///< Without nodes and edges.
  std::vector<std::map<NodeType, NodeId>> next_ids;  ///< By storey.

  [[nodiscard]] std::size_t storeyCount() const { return next_ids.size(); }
  [[nodiscard]] RoomPipelineState& roomsOf(std::size_t storey) {
    return storey == 0 ? state : state.further_storeys[storey - 1];
  }
};

/// @throws Error naming `where` and the value that cannot be used.
[[nodiscard]] SessionJson parseSessionJson(const std::string& text, const std::string& where);

}  // namespace occusg
