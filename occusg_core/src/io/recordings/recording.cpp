// SPDX-License-Identifier: BSD-3-Clause
#include "io/recordings/recording.hpp"

#include <array>
#include <filesystem>
#include <map>

#include "io/recordings/camera_file.hpp"
#include "io/recordings/folder_names.hpp"
#include "io/recordings/recording_layouts.hpp"
#include "io/text_lines.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

namespace fs = std::filesystem;

struct Layout {
  bool (*is)(const std::string& folder);
  Recording (*read)(const std::string& folder, const SequenceReaderConfig& config);
};

constexpr std::array<Layout, 6> kLayouts = {{{isTumRecording, readTumRecording},
                                             {isSevenScenesRecording, readSevenScenesRecording},
                                             {isScanNetRecording, readScanNetRecording},
                                             {isReplicaRecording, readReplicaRecording},
                                             {isRtabmapRecording, readRtabmapRecording},
                                             {isIclNuimRecording, readIclNuimRecording}}};

/// A file that tells what a folder is when it is no recording.
struct Giveaway {
  const char* name;
  const char* what;
  const char* advice;
};

constexpr std::array<Giveaway, 5> kOthers = {{
    {"session.json", "is a saved session", "'--resume' continues it with a recording"},
    {"scene_graph.json", "holds results of 'occusg run'", "'occusg show' prints them"},
    {"map.yaml", "holds a 2D map", "'occusg segment' reads map.yaml"},
    {"transforms.json", "holds poses for NeRF", "depth images in a known layout are needed"},
    {"rooms.json", "holds rooms", "'occusg eval' compares them with others"},
}};

constexpr const char* kKnownLayouts =
    "known layouts are TUM RGB-D (depth.txt, groundtruth.txt, camera.json), 7-Scenes "
    "(frame-000000.depth.png), ScanNet export (depth/, pose/, intrinsic/), Replica of NICE-SLAM "
    "(results/, traj.txt), ICL-NUIM (depth/, *.gt.freiburg) and RTAB-Map export (*_depth/, "
    "*_calib/, *_poses.txt)";

/// "3 folders (a, b, c), 12 .png, 2 .txt".
std::string contentsOf(const std::string& folder) {
  constexpr std::size_t kShownFolders = 4;
  std::map<std::string, std::size_t> endings;
  std::string folders;
  std::size_t folder_count = 0;
  for (const std::string& name : namesIn(folder)) {
    if (!isFolderIn(folder, name)) {
      const std::string ending = fs::path(name).extension().string();
      ++endings[ending.empty() ? "files without an ending" : shown(ending)];
    } else if (++folder_count <= kShownFolders) {
      folders += (folders.empty() ? "" : ", ") + shown(name);
    }
  }
  std::string text;
  if (folder_count > 0) {
    text = std::to_string(folder_count) + (folder_count == 1 ? " folder (" : " folders (") +
           folders + (folder_count > kShownFolders ? ", ..." : "") + ")";
  }
  for (const auto& [ending, count] : endings)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + ending;
  return text.empty() ? "nothing" : text;
}

/// The layout that the folder has most of, and what it lacks.
std::string nearestLayout(const std::string& folder) {
  const auto has = [&](const char* name) { return existsIn(folder, name); };
  if (has("traj.txt")) return "nearest is Replica of NICE-SLAM, but results/ is missing";
  if (has("results")) return "nearest is Replica of NICE-SLAM, but traj.txt is missing";
  if (has("pose") || has("poses"))
    return "nearest is ScanNet export, but depth/ or pose/ is missing";
  if (has("depth") || has("rgb.txt") || has("rgb"))
    return "nearest is TUM RGB-D, but depth.txt, groundtruth.txt and camera.json are missing";
  return kKnownLayouts;
}

[[noreturn]] void refuseFolder(const std::string& folder) {
  for (const Giveaway& other : kOthers) {
    if (existsIn(folder, other.name))
      throw refuse(folder, std::string(other.what) + ", not a recording", other.advice);
  }
  for (const std::string& name : namesIn(folder)) {
    if (!isFolderIn(folder, name)) continue;
    for (const Layout& layout : kLayouts) {
      if (layout.is(joined(folder, name))) {
        throw refuse(folder, "holds recordings in folders of its own, and is none itself",
                     "name one, as in " + joined(folder, shown(name)));
      }
    }
  }
  throw refuse(folder, "is no recording of a known layout; it holds " + contentsOf(folder),
               nearestLayout(folder));
}

/// A file is named for what it is.
[[noreturn]] void refuseFile(const std::string& path) {
  static const std::map<std::string, const char*> kAdvice = {
      {".bag", "'rosrun occusg occusg_bag' reads a bag"},
      {".sens", "ScanNet's SensReader exports a .sens file to a folder that can be read"},
      {".db", "rtabmap-export --images --poses_camera --poses_format 11 makes a folder of it"},
      {".klg", "a folder in the TUM RGB-D layout is needed"},
      {".bt", "'occusg project' reads an OctoMap"},
      {".ot", "'occusg project' reads an OctoMap"},
      {".yaml", "'occusg segment' reads a 2D map"},
      {".pgm", "'occusg segment' reads a 2D map"},
      {".json", "'occusg show' reads a scene graph"}};
  const auto advice = kAdvice.find(fs::path(path).extension().string());
  throw refuse(path, "is not a folder that can be read",
               advice == kAdvice.end() ? "the folder of a sequence is needed" : advice->second);
}

/// The axes of a body (x forward, y left, z up) as those of its camera (REP 103).
Eigen::Matrix3d bodyFromOptical() {
  Eigen::Matrix3d R_body_optical;
  R_body_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return R_body_optical;
}

}  // namespace

Recording readRecording(const std::string& folder, const SequenceReaderConfig& config) {
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) refuseFile(folder);
  for (const Layout& layout : kLayouts) {
    if (!layout.is(folder)) continue;
    Recording recording = layout.read(folder, config);
    if (config.depth_units_per_m)
      recording.depth_units_per_m = checkedDepthUnits(*config.depth_units_per_m, "--depth-scale");
    if (config.pose_frame == PoseFrame::kBody) {
      for (RecordedPose& pose : recording.poses)
        pose.T_map_camera.linear() = pose.T_map_camera.linear() * bodyFromOptical();
    }
    return recording;
  }
  refuseFolder(folder);
}

}  // namespace occusg
