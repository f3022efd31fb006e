// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <string>

#include "occusg/mapping/occupancy_map.hpp"
#include "occusg/pipeline/pipeline.hpp"

namespace occusg {

/// Version of `session.json`; counts up when a reader of the old one would misread the new one.
inline constexpr int kSessionVersion = 1;
/// That of a session of several storeys.
inline constexpr int kStoreysSessionVersion = 2;

/// Checks, before a long run, that a session can be saved there.
/// @throws Error when `folder` is a file, or a folder that holds something else than a session.
void checkSessionPlace(const std::string& folder);

/// Saves a session as a folder of `map.ot`, `scene_graph.json`, a `scene_graph_<storey>.json` for
/// each further storey, and `session.json`, which holds the rest and the sizes and checksums of the
/// others. The folder is written under another name
/// beside its place, flushed and renamed: a crash leaves the session that was there or the new one,
/// never a mixture.
/// @throws Error as `checkSessionPlace`, or when it cannot be written; what was there is untouched.
void saveSession(const std::string& folder, const octomap::OcTree& map, const SessionState& state);
/// The same without a map, for a system whose map is somewhere else or in two dimensions only.
void saveSession(const std::string& folder, const SessionState& state);

/// @param config of the map; its resolution must be the session's.
/// @throws Error naming the file and the fault: a file missing, of another size or content than
/// `session.json` says, another version, a value that cannot be.
[[nodiscard]] Session loadSession(const std::string& folder, const OccupancyMapConfig& config);

}  // namespace occusg
