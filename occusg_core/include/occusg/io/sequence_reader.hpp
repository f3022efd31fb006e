// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/perception/camera_model.hpp"
#include "occusg/perception/depth_frame.hpp"

namespace occusg {

struct Recording;

/// Which axes a recording's poses turn (REP 103).
enum class PoseFrame {
  kOptical,  ///< The camera's: x right, y down, z forward.
  kBody      ///< The robot's or the camera body's: x forward, y left, z up.
};

/// How the poses between two images are filled in.
struct PoseInterpolationLimits {
  double max_gap_s = 1.0;      ///< Between the two poses [s].
  double max_gap_m = 0.5;      ///< Between the two poses [m].
  double max_gap_rad = 0.525;  ///< Between the two poses [rad].
};

/// How a recording is read, where its own files do not say it.
struct SequenceReaderConfig {
  /// A frame takes the pose (and the colour image) nearest in time, at most so far away [s].
  double max_time_offset_s = 0.02;
  /// Trajectory to read in place of the recording's own; empty: its own.
  std::string poses_path = {};
  /// Camera file to read in place of the recording's own; empty: its own.
  std::string camera_path = {};
  /// Pixel value of one metre, in place of the recording's own.
  std::optional<double> depth_units_per_m = {};
  PoseFrame pose_frame = PoseFrame::kOptical;
  /// Quaternions are qw qx qy qz also where no header of the trajectory says so.
  bool w_first = false;
  /// A frame without a pose near in time takes one between the poses before and after it.
  PoseInterpolationLimits interpolation = {};
};

/// One recorded frame: a depth image (CV_16UC1, of the camera's size), and where it came from.
struct Frame : DepthFrame {
  std::string depth_path;                 ///< The file `depth` was read from.
  std::optional<std::string> color_path;  ///< Of the colour image nearest in time, if any.
  std::optional<std::string> label_path;  ///< `labels/<name of the depth file>`, if there is one.
};

/// A recorded sequence in the layout of the TUM RGB-D benchmark (Sturm et al., IROS 2012):
/// `depth.txt` (`stamp path`), `groundtruth.txt` (`stamp tx ty tz qx qy qz qw`, camera optical
/// frame in the world), 16-bit depth PNGs and `camera.json` {width, height, fx, fy, cx, cy,
/// depth_scale}; optionally `rgb.txt`, `labels/` and `rooms.json`. Also a folder in the layout of
/// 7-Scenes, ScanNet's export, Replica as NICE-SLAM renders it, ICL-NUIM or RTAB-Map's export.
/// Images are read one at a time, when asked for.
///
/// Each line of `depth.txt` that is not blank or a comment is a frame. What spoils a single frame
/// (a broken line, image or pose) is thrown by `read` of that frame and leaves the others usable;
/// what spoils the whole sequence is thrown by the constructor. The stamps of the frames that can
/// be read increase strictly.
class SequenceReader {
 public:
  /// @throws Error naming file, line and value: a folder or list missing, empty or too long, or a
  /// `camera.json` that does not describe a camera.
  explicit SequenceReader(const std::string& folder, const SequenceReaderConfig& config = {});

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] const CameraModel& camera() const;
  /// Name of the folder: what the scene is called.
  [[nodiscard]] const std::string& scene() const { return scene_; }
  /// Path of `rooms.json`, the true rooms, if the sequence has one.
  [[nodiscard]] std::optional<std::string> truthPath() const;
  /// One sentence for each line of the poses and of `rgb.txt` that cannot be used; at most
  /// 100.
  [[nodiscard]] const std::vector<std::string>& unusableLines() const;

  /// Name of the layout the folder has.
  [[nodiscard]] const std::string& layout() const;
  /// What the files leave open and how it was taken, one sentence each.
  [[nodiscard]] const std::vector<std::string>& assumptions() const;
  /// How many frames take a pose between two others, as none is near enough in time.
  [[nodiscard]] std::size_t interpolatedPoses() const;

  /// Reads frame `index`.
  /// @throws Error when this frame cannot be used: its line is malformed, goes back in time or
  /// leaves the folder; the image is missing, truncated, damaged, of another size than the camera's
  /// or not 16-bit with one channel; no usable pose lies near enough in time. Also when `index` is
  /// not below `size()`.
  [[nodiscard]] Frame read(std::size_t index) const;

 private:
  [[nodiscard]] std::optional<Pose> interpolatedPose(double stamp_s) const;
  [[nodiscard]] bool hasPoseNear(double stamp_s) const;
  [[nodiscard]] Pose poseAt(double stamp_s) const;
  [[nodiscard]] DepthImage depthIn(const std::string& path) const;
  [[nodiscard]] std::string pathOf(const std::string& name) const;

  std::string folder_;
  SequenceReaderConfig config_;
  std::string scene_;
  std::shared_ptr<const Recording> recording_;
};

}  // namespace occusg
