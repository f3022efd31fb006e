// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "occusg/io/session_state.hpp"

namespace occusg {

/// Size and content of a file, to tell a damaged one.
struct FileMark {
  std::size_t bytes = 0;
  std::uint64_t checksum = 0;  ///< FNV-1a, 64 bit (Fowler, Noll, Vo).
};

[[nodiscard]] FileMark markOf(const std::string& bytes);

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
