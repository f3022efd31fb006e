// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/io/session_folder.hpp"

namespace occusg {

/// Stamps after `latest_s` cannot be: one message from the future leaves them, and no frame is
/// younger then. They become the latest stamp of the session that can be, or `latest_s` where there
/// is none.
/// @return how many there were.
std::size_t repairStamps(SessionState& state, double latest_s);

/// A session, and what had to be changed to read it, a sentence each.
struct RepairedSession {
  Session session;
  std::vector<std::string> repairs;
};

/// Reads a session that `loadSession` may refuse. What can be read of it stays: parts that changed
/// since they were saved are taken as they are; a map that cannot be read is left out, nodes too
/// far away for a graph and what hangs on them too; far islands are cut off the map; stamps after
/// `latest_s` are repaired.
/// @throws Error when `session.json` or the graph cannot be read at all.
[[nodiscard]] RepairedSession readForRepair(const std::string& folder,
                                            const OccupancyMapConfig& config, double latest_s);

}  // namespace occusg
