// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "io/session_json.hpp"

namespace occusg {

inline constexpr const char* kSessionFile = "session.json";
inline constexpr const char* kMapFile = "map.ot";
inline constexpr std::size_t kMaxSessionBytes = std::size_t{64} << 20U;
inline constexpr std::size_t kMaxPartBytes = std::size_t{1} << 30U;

/// The session at the path, or what a save that was killed between two steps set aside.
[[nodiscard]] std::filesystem::path sessionAt(const std::string& folder);

/// Gives the rooms of a storey their graph and the ids that are used up.
/// @throws Error naming `where` when the session names what the graph has not.
void addGraph(SessionJson& session, std::size_t storey, SceneGraph graph, const std::string& where);

}  // namespace occusg
