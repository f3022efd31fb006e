// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "occusg/geometry/pose.hpp"
#include "occusg/perception/camera_model.hpp"
#include "occusg/perception/depth_frame.hpp"

namespace occusg {

struct SequenceReaderConfig {
  /// A frame takes the pose (and the colour image) nearest in time, at most so far away [s].
  double max_time_offset_s = 0.02;
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
/// depth_scale}; optionally `rgb.txt`, `labels/` and `rooms.json`. Images are read one at a time,
/// when asked for.
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

  [[nodiscard]] std::size_t size() const { return frames_.size(); }
  [[nodiscard]] const CameraModel& camera() const { return camera_; }
  /// Name of the folder: what the scene is called.
  [[nodiscard]] const std::string& scene() const { return scene_; }
  /// Path of `rooms.json`, the true rooms, if the sequence has one.
  [[nodiscard]] std::optional<std::string> truthPath() const;
  /// One sentence for each line of `groundtruth.txt` and `rgb.txt` that cannot be used; at most
  /// 100.
  [[nodiscard]] const std::vector<std::string>& unusableLines() const { return unusable_lines_; }

  /// Reads frame `index`.
  /// @throws Error when this frame cannot be used: its line is malformed, goes back in time or
  /// leaves the folder; the image is missing, truncated, damaged, of another size than the camera's
  /// or not 16-bit with one channel; no usable pose lies near enough in time. Also when `index` is
  /// not below `size()`.
  [[nodiscard]] Frame read(std::size_t index) const;

 private:
  /// A line of `depth.txt` or `rgb.txt`.
  struct ImageEntry {
    double stamp_s = 0.0;
    std::string path;     ///< Relative to the folder.
    std::string problem;  ///< Why it cannot be used; empty when it can.
  };
  /// A line of `groundtruth.txt`.
  struct PoseEntry {
    double stamp_s = 0.0;
    Pose T_map_camera = Pose::Identity();
    std::string problem;  ///< Why it cannot be used; empty when it can.
  };

  void readCamera();
  void readDepthList();
  void readColorList();
  void readPoses();
  [[nodiscard]] Pose poseAt(double stamp_s) const;
  [[nodiscard]] std::string pathOf(const std::string& name) const;

  std::string folder_;
  SequenceReaderConfig config_;
  std::string scene_;
  CameraModel camera_;
  double depth_units_per_m_ = 1000.0;
  std::vector<ImageEntry> frames_;         ///< In the order of the file.
  std::vector<ImageEntry> color_images_;   ///< Usable ones, by time.
  std::vector<PoseEntry> poses_;           ///< Usable ones, by time.
  std::vector<PoseEntry> unusable_poses_;  ///< Those whose time is known, by time.
  std::vector<std::string> unusable_lines_;
};

}  // namespace occusg
