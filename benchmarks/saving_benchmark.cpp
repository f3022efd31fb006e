// SPDX-License-Identifier: BSD-3-Clause
// What a save of a large map costs the process that maps, and what a month of driving leaves in a
// session. Prints one JSON object:
//   map       of an explored building: MiB the process holds, the share a save of `mapping` adds at
//             its peak (it copies the map's bytes, then writes them), ms the copy blocks mapping;
//   agents    offered half a metre apart: how many stay, seconds to save and to load, MiB at the
//             peak.
// Usage: saving_benchmark FOLDER [AREA_M2 [AGENTS]]     FOLDER receives map.ot and session/
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

#include "generated_building.hpp"
#include "graph/agent_layer.hpp"
#include "occusg/io/octomap_file.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/session_folder.hpp"
#include "occusg/mapping/occupancy_map.hpp"
#include "occusg_ros/chunked_buffer.hpp"

namespace occusg {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Of /proc/self/status [MiB].
double memoryLine(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0.0;
    if (word == name + ":" && status >> kibibytes) return kibibytes / 1024.0;
  }
  return 0.0;
}

void forgetPeak() { std::ofstream("/proc/self/clear_refs") << "5"; }

void saveMap(const std::string& folder, double area_m2) {
  const GeneratedBuilding building = buildingOf(area_m2);
  OccupancyMapConfig config;
  config.max_memory_mb = 1e6;
  OccupancyMap map{config};
  explore(building, 0, map);
  const double resident_mib = memoryLine("VmRSS");
  forgetPeak();
  const Clock::time_point start = Clock::now();
  double blocked_s = 0.0;
  {
    occusg_ros::ChunkedBuffer bytes;
    std::ostream stream(&bytes);
    writeOctomap(map.tree(), OctomapEncoding::kFull, stream);
    blocked_s = secondsSince(start);
    (void)OutputFolder(folder).write("map.ot", [&](std::ostream& out) { bytes.writeTo(out); });
  }
  std::cout << ", \"map\": {\"area_m2\": " << building.area()
            << ", \"resident_mib\": " << resident_mib
            << ", \"added_share\": " << memoryLine("VmHWM") / resident_mib - 1.0
            << ", \"blocked_ms\": " << 1e3 * blocked_s << ", \"save_s\": " << secondsSince(start)
            << "}}\n";
}

/// A drive up and down the corridors of a building, half a metre at a time, one a second.
Pose poseOf(int step) {
  constexpr double kStep_m = 0.5;
  constexpr int kStepsOfARow = 200;
  constexpr int kRows = 100;
  const int row = step / kStepsOfARow % kRows;
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(kStep_m * (step % kStepsOfARow), row, 1.2);
  return pose;
}

void saveAgents(const std::string& folder, int count) {
  forgetPeak();
  SessionState state;
  state.scene = "month";
  AgentLayer agents{AgentLayerConfig{}};
  const Clock::time_point drive = Clock::now();
  for (int i = 0; i < count; ++i) (void)agents.observe(state.graph.graph, poseOf(i), i);
  const double drive_s = secondsSince(drive);
  state.stamp_s = count;
  const Clock::time_point saving = Clock::now();
  saveSession(folder + "/session", state);
  const double save_s = secondsSince(saving);
  const Clock::time_point loading = Clock::now();
  const Session loaded = loadSession(folder + "/session", OccupancyMapConfig{});
  std::cout << "{\"agents\": {\"offered\": " << count
            << ", \"kept\": " << loaded.state.graph.graph.nodes(NodeType::kAgent).size()
            << ", \"drive_s\": " << drive_s << ", \"save_s\": " << save_s
            << ", \"load_s\": " << secondsSince(loading)
            << ", \"peak_mib\": " << memoryLine("VmHWM") << "}";
}

}  // namespace
}  // namespace occusg

int main(int argc, char** argv) {
  const double area_m2 = argc > 2 ? std::atof(argv[2]) : 10000.0;
  const int agents = argc > 3 ? std::atoi(argv[3]) : 1'000'000;
  if (argc < 2 || argc > 4 || !(area_m2 >= 1.0 && area_m2 <= 1e6) || agents < 1) {
    std::cerr << "usage: saving_benchmark FOLDER [AREA_M2 [AGENTS]]\n";
    return 2;
  }
  try {
    occusg::saveAgents(argv[1], agents);
    occusg::saveMap(argv[1], area_m2);
  } catch (const std::exception& error) {
    std::cerr << "saving_benchmark: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
