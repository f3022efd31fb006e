// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/recordings/recording.hpp"

namespace occusg {

/// A trajectory file: poses that can be used and poses that cannot.
struct Trajectory {
  std::vector<RecordedPose> poses;     ///< Usable ones, in the order of the file.
  std::vector<RecordedPose> unusable;  ///< Those whose time is known.
  /// Of `poses`, when the file has a column of ids (RTAB-Map's format 11); else empty.
  std::vector<long> ids;
  /// The file holds matrices without time stamps; stamps are then the poses' positions, from 0.
  bool is_numbered = false;
  std::vector<std::string> unusable_lines;  ///< One sentence each; at most 100.
  std::vector<std::string> assumptions;
};

/// Reads a trajectory, whichever of these it is: "timestamp tx ty tz qx qy qz qw" (TUM, ORB-SLAM,
/// RTAB-Map's formats 1 and 10, with a column "id" format 11); the same separated by commas, with
/// further columns and w first when the header says so (EuRoC); matrices of 3 x 4 or 4 x 4 in a
/// row each, without stamps (KITTI, NICE-SLAM). Stamps in ns, us or ms are recognised by their
/// size.
/// @throws Error naming file, line and value when no pose can be used.
[[nodiscard]] Trajectory readTrajectory(const std::string& path,
                                        const SequenceReaderConfig& config);

/// The pose in a file that holds one matrix of 4 x 4.
/// @throws Error naming the file.
[[nodiscard]] Pose readPoseFile(const std::string& path);

/// Seconds in a unit of a clock that shows such stamps: 1 below 1e11, else the largest of ms, us
/// and ns that gives a date after 1970 and before the year 5000.
[[nodiscard]] double secondsPerUnit(double largest_stamp);

/// Why a word is not what a field needs.
[[nodiscard]] std::string numberProblem(const std::string& where, const std::string& field,
                                        const std::string& word);

/// Puts the trajectory into the recording, sorted by time.
void adopt(Trajectory trajectory, const std::string& path, Recording& recording);

/// Reads `<stem of the image><suffix>` for each depth image: a matrix of 4 x 4 (7-Scenes, ScanNet).
/// A file that cannot be used spoils its own frame only.
/// @param pose_paths one for each depth image, relative to the folder.
void adoptPoseFiles(const std::string& folder, const std::vector<std::string>& pose_paths,
                    Recording& recording);

}  // namespace occusg
