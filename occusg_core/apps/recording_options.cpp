// SPDX-License-Identifier: BSD-3-Clause
#include "recording_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "command_line.hpp"
#include "occusg/error.hpp"
#include "occusg/perception/map_orientation.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

constexpr std::size_t kSampledFrames = 40;
constexpr double kRadToDeg = 180.0 / 3.14159265358979323846;
/// From there on the map, or the camera, is upside down.
constexpr double kUpsideDown_deg = 150.0;
/// So near the map is taken as right.
constexpr double kRight_deg = 30.0;

std::string rounded(double value, int digits) {
  std::string text(32, '\0');
  const int length = std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  text.resize(static_cast<std::size_t>(std::max(0, length)));
  return text;
}

MapOrientation orientationOf(const SequenceReader& sequence) {
  MapOrientationEstimator estimator;
  const std::size_t step = std::max<std::size_t>(1, sequence.size() / kSampledFrames);
  for (std::size_t i = 0; i < sequence.size(); i += step) {
    try {
      estimator.add(sequence.read(i));
    } catch (const Error&) {  // told when the frame's turn comes
      continue;
    }
  }
  return estimator.estimate();
}

bool looksRight(const MapOrientation& orientation) {
  return hasCommonDown(orientation) && orientation.down_off_rad * kRadToDeg <= kRight_deg;
}

/// The option with which the poses' axes would be right; empty for none.
std::string mendedBy(const std::string& folder, const SequenceReaderConfig& reading) {
  SequenceReaderConfig body = reading;
  body.pose_frame = PoseFrame::kBody;
  if (reading.pose_frame != PoseFrame::kBody &&
      looksRight(orientationOf(SequenceReader(folder, body))))
    return "--pose-frame body";
  SequenceReaderConfig w_first = reading;
  w_first.w_first = true;
  if (!reading.w_first && looksRight(orientationOf(SequenceReader(folder, w_first))))
    return "--quaternion wxyz";
  return "";
}

/// What is wrong with where down is; empty when nothing is seen to be.
std::string sentenceOnDown(const MapOrientation& orientation, const std::string& folder,
                           const SequenceReaderConfig& reading) {
  const bool agree = hasCommonDown(orientation);
  if (agree && !isTilted(orientation)) return "";
  const std::string option = mendedBy(folder, reading);
  // A camera that looks at the floor has no common direction either.
  if (!agree && option.empty()) return "";
  std::string sentence = "down in the images is no common direction in the map: ";
  if (agree) {
    sentence = "down in the images is about " + rounded(orientation.down_off_rad * kRadToDeg, 0) +
               " degrees away from the map's -z: is z up? ";
  }
  if (!option.empty()) return sentence + "with " + option + " it would be the map's -z";
  sentence += "--level turns the map so that it is";
  // Images of a camera that hangs upside down under a map that lies right are the same.
  if (orientation.down_off_rad * kRadToDeg < kUpsideDown_deg) return sentence;
  return sentence + ", unless the camera was mounted upside down: then nothing is to be done";
}

std::string sentenceOnFloor(double floor_z_m) {
  return "the lowest floor that was seen is " + rounded(std::abs(floor_z_m), 1) + " m " +
         (floor_z_m < 0.0 ? "below" : "above") +
         " z = 0: is the depth scale right (--depth-scale), and is the floor at z = 0? --level "
         "moves it there";
}

}  // namespace

void addRecordingOptions(po::options_description& options) {
  options.add_options()("poses", po::value<std::string>(),
                        "trajectory to use in place of the recording's own: TUM, ORB-SLAM, "
                        "RTAB-Map, EuRoC, or matrices in rows")(
      "camera", po::value<std::string>(),
      "camera file to use in place of the recording's own: camera.json, Open3D's JSON, the YAML of "
      "camera_calibration, or a matrix")("depth-scale", po::value<double>(),
                                         "pixel value of one metre in the depth images")(
      "pose-frame", po::value<std::string>(),
      "optical: poses are those of the camera, z forward (default); body: x forward, z up")(
      "quaternion", po::value<std::string>(),
      "wxyz: the poses' quaternions have w first; xyzw: w last, unless a header says otherwise")(
      "level", "turn and move the map so that z is up and the floor is at z = 0");
}

SequenceReaderConfig readingFrom(const po::variables_map& values) {
  SequenceReaderConfig reading;
  reading.poses_path = given<std::string>(values, "poses").value_or("");
  reading.camera_path = given<std::string>(values, "camera").value_or("");
  reading.depth_units_per_m = given<double>(values, "depth-scale");
  const std::string frame = given<std::string>(values, "pose-frame").value_or("optical");
  if (frame != "optical" && frame != "body")
    throw UsageError("--pose-frame is '" + frame + "'; allowed is optical or body");
  reading.pose_frame = frame == "body" ? PoseFrame::kBody : PoseFrame::kOptical;
  const std::string order = given<std::string>(values, "quaternion").value_or("xyzw");
  if (order != "xyzw" && order != "wxyz")
    throw UsageError("--quaternion is '" + order + "'; allowed is xyzw or wxyz");
  reading.w_first = order == "wxyz";
  return reading;
}

Placement placementOf(const SequenceReader& sequence, const std::string& folder,
                      const SequenceReaderConfig& reading, bool level) {
  Placement placement;
  placement.doubts = sequence.assumptions();
  if (const std::size_t count = sequence.interpolatedPoses(); count > 0) {
    placement.doubts.push_back(
        std::to_string(count) + " of " + std::to_string(sequence.size()) +
        " images have no pose of their time; theirs are interpolated between poses at most " +
        rounded(reading.interpolation.max_gap_s, 1) + " s, " +
        rounded(reading.interpolation.max_gap_m, 1) + " m and " +
        rounded(reading.interpolation.max_gap_rad * kRadToDeg, 0) + " degrees apart");
  }
  const MapOrientation orientation = orientationOf(sequence);
  if (level) {
    placement.T_level_map = levelling(orientation);
    const double turned_rad = std::acos(std::clamp(orientation.up.z(), -1.0, 1.0));
    placement.levelled = "levelled: the map was turned by " + rounded(turned_rad * kRadToDeg, 1) +
                         " degrees, and moved along z by " +
                         rounded(placement.T_level_map.translation().z(), 2) + " m";
    return placement;
  }
  const std::string down = sentenceOnDown(orientation, folder, reading);
  if (!down.empty()) {
    placement.doubts.push_back(down);
  } else if (hasFarFloor(orientation)) {
    placement.doubts.push_back(sentenceOnFloor(*floorAtMiddle_m(orientation)));
  }
  return placement;
}

}  // namespace occusg::apps
