// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/io/sequence_reader.hpp"
#include "occusg/perception/camera_model.hpp"

namespace occusg {

/// More lines that cannot be used are not told one by one.
inline constexpr std::size_t kMaxUnusableLines = 100;

/// An image of a recording.
struct RecordedImage {
  double stamp_s = 0.0;
  std::string path;     ///< Relative to the folder.
  std::string problem;  ///< Why it cannot be used; empty when it can.
};

/// A pose of a recording.
struct RecordedPose {
  double stamp_s = 0.0;
  Pose T_map_camera = Pose::Identity();
  std::string problem;  ///< Why it cannot be used; empty when it can.
};

/// What a folder holds, whatever its layout; images are named, not read.
struct Recording {
  std::string layout;
  CameraModel camera;
  double depth_units_per_m = 1000.0;
  /// The first row of an image is its lowest (ICL-NUIM).
  bool rows_go_up = false;
  /// The highest pixel value means "no return" too (Kinect, as 7-Scenes stores it).
  bool highest_value_is_no_return = false;
  std::vector<RecordedImage> depth_images;   ///< In the order of the file, or of their numbers.
  std::vector<RecordedImage> color_images;   ///< Usable ones, by time.
  std::vector<RecordedPose> poses;           ///< Usable ones, by time.
  std::vector<RecordedPose> unusable_poses;  ///< Those whose time is known, by time.
  std::string poses_path;                    ///< For sentences.
  std::vector<std::string> unusable_lines;   ///< One sentence each; at most 100.
  std::vector<std::string> assumptions;      ///< What the files leave open; one sentence each.
};

/// Reads what `folder` lists, in the layout it has.
/// @throws Error naming file, line and value, or what the folder holds when its layout is unknown.
[[nodiscard]] Recording readRecording(const std::string& folder,
                                      const SequenceReaderConfig& config);

}  // namespace occusg
