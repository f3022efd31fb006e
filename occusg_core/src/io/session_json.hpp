// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "io/file_mark.hpp"
#include "occusg/pipeline/room_pipeline.hpp"

namespace occusg {

/// The text of a `session.json`: everything of the state but the nodes and edges of its graph.
[[nodiscard]] std::string toSessionJson(const SessionState& state,
                                        const std::map<std::string, FileMark>& files);

struct SessionJson {
  std::map<std::string, FileMark> files;
  SessionState state;  ///< Without nodes and edges.
  std::map<NodeType, NodeId> next_ids;
};

/// @throws Error naming `where` and the value that cannot be used.
[[nodiscard]] SessionJson parseSessionJson(const std::string& text, const std::string& where);

}  // namespace occusg
