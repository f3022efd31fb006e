// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "occusg/error.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/session_folder.hpp"
#include "occusg/io/session_repair.hpp"
#include "occusg/pipeline/config_file.hpp"
#include "wall_clock.hpp"

namespace occusg::apps {
namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

/// Sessions of occusg/scene_graph have none, as its map is another node's.
constexpr const char* kNoMap = ", but has no 3D map: --map names one when it is resumed";

CommandHelp sessionHelp() {
  return {
      "occusg session check|repair DIR [options]",
      "Tells whether a saved session can be gone on from, or makes one of it that can.\n\n"
      "check prints what is wrong, and ends with exit code 1 if anything is. repair keeps what\n"
      "can be read and saves it at DIR; the session as it was goes to DIR.unrepaired. Repaired\n"
      "are files that were changed, stamps from the future, nodes and parts of the map that a\n"
      "pose that jumped left far away, and a save that was killed between two steps.\n\n"
      "  occusg session check building\n"
      "  occusg session repair building\n",
      {"ACTION", "DIR"}};
}

/// With the resolution of the session's own map.
OccupancyMapConfig mapConfigFor(const std::string& folder, const PipelineConfig& config) {
  OccupancyMapConfig map = config.occupancy;
  const fs::path file = fs::path(folder) / "map.ot";
  if (!fs::exists(file)) return map;
  try {
    map.resolution_m = readOctomapHeader(file.string()).resolution_m;
  } catch (const Error&) {
    // Whoever reads the map says what is wrong with it.
  }
  return map;
}

void save(const std::string& folder, const Session& session) {
  if (session.map) {
    saveSession(folder, session.map->tree(), session.state);
  } else {
    saveSession(folder, session.state);
  }
}

void keepAsItWas(const std::string& folder) {
  if (!fs::exists(folder)) return;
  const std::string kept = fs::path(folder + "/").parent_path().string() + ".unrepaired";
  if (fs::exists(kept))
    throw refuse(kept, "is there already", "move it away: it is the session before a repair");
  fs::copy(folder, kept, fs::copy_options::recursive);
  std::cout << "The session as it was is " << kept << '\n';
}

}  // namespace

ExitCode sessionCommand(const std::vector<std::string>& arguments) {
  po::options_description options("Options");
  addConfigOption(options);
  const po::variables_map values = parse(arguments, sessionHelp(), options);
  if (helpWasPrinted(values)) return kFine;
  const std::string action = values["ACTION"].as<std::string>();
  const std::string folder = values["DIR"].as<std::string>();
  if (action != "check" && action != "repair")
    throw UsageError("'" + action + "' is nothing to do with a session; allowed are check, repair");

  const PipelineConfig config = givenConfig(values);
  const RepairedSession read =
      readForRepair(folder, mapConfigFor(folder, config), latestCredibleStamp());
  for (const std::string& repair : read.repairs) std::cout << repair << '\n';
  if (read.repairs.empty()) {
    std::cout << folder << ": is fine" << (read.session.map ? "" : kNoMap) << '\n';
    return kFine;
  }
  if (action == "check") return kFailed;
  keepAsItWas(folder);
  save(folder, read.session);
  std::cout << folder << ": is repaired" << (read.session.map ? "" : kNoMap) << '\n';
  return kFine;
}

}  // namespace occusg::apps
