// SPDX-License-Identifier: BSD-3-Clause
// Plays a recorded sequence as the topics and tf of a robot, or writes them into a bag.
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <iostream>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/io/sequence_reader.hpp"
#include "occusg_ros/sequence_messages.hpp"
#include "recorded_detections.hpp"
#include "tool_options.hpp"

namespace {

namespace po = boost::program_options;
using occusg_ros::FrameMessages;
using occusg_ros::FrameNames;

constexpr double kClockStep_s = 0.01;  // of the wall
constexpr double kStandStep_s = 0.1;   // between two poses of the robot that has arrived
constexpr double kPatience_s = 60.0;   // for subscribers
constexpr int kMaxScale = 8;
// ROS takes a stamp of zero for none.
constexpr double kFirstStamp_s = 1000.0;

struct Options {
  std::vector<std::string> sequences;
  std::string bag;
  FrameNames frames;
  std::string camera = "camera";
  std::string detections = "/occusg/detections";
  double rate = 1.0;
  double hold_s = 0.0;
  int scale = 1;
  bool clock = false;
  bool loop = false;
  bool wait = false;
  bool with_color = true;
};

/// Where a frame's messages go.
struct Publishers {
  ros::Publisher clock, tf, odometry, info, depth, color, detections;
};

bool parse(int argc, char** argv, Options& options) {
  po::options_description named(
      "occusg_play SEQUENCE [options]\n\n"
      "Plays a recorded RGB-D sequence as depth/image_rect, depth/camera_info and\n"
      "rgb/image_rect_color of a camera, odom and /tf; or writes them into a bag.\n\nOptions");
  named.add_options()("bag", po::value(&options.bag), "write this bag instead of playing")(
      "rate", po::value(&options.rate), "so many times as fast as recorded")(
      "scale", po::value(&options.scale), "so many pixels for one, in both directions")(
      "clock", po::bool_switch(&options.clock), "publish /clock; stamps begin at 1000 s")(
      "loop", po::bool_switch(&options.loop), "begin again at the end")(
      "hold", po::value(&options.hold_s), "stand for so long at the end [s]")(
      "wait", po::bool_switch(&options.wait), "wait until somebody listens to the depth images")(
      "no-color", "leave the colour images out")(
      "detections", po::value(&options.detections),
      "topic of the objects that labels/ shows (occusg/DetectionArray); '' for none")(
      "camera", po::value(&options.camera), "name of the camera's topics")(
      "map-frame", po::value(&options.frames.map), "name of the map's frame")(
      "robot-frame", po::value(&options.frames.robot), "name of the robot's frame")(
      "camera-frame", po::value(&options.frames.camera), "name of the camera's optical frame");
  const auto values = occusg_ros::parseToolOptions(argc, argv, named, options.sequences);
  if (!values) return false;
  options.with_color = values->count("no-color") == 0;
  if (options.sequences.size() != 1) throw occusg::Error("name one sequence; see --help");
  if (!(options.rate > 0.0)) throw occusg::Error("--rate must be above 0");
  if (options.scale < 1 || options.scale > kMaxScale)
    throw occusg::Error("--scale must be 1 to " + std::to_string(kMaxScale));
  return true;
}

/// The frame as a camera with more pixels would have seen it.
void enlarge(occusg::Frame& frame, int scale) {
  if (scale == 1) return;
  cv::Mat pixels;
  cv::resize(frame.depth.pixels, pixels, {}, scale, scale, cv::INTER_NEAREST);
  frame.depth.pixels = pixels;
  occusg::CameraModel& camera = frame.camera;
  camera.width *= scale;
  camera.height *= scale;
  camera.fx *= scale;
  camera.fy *= scale;
  // The centre of a pixel moves to the centre of the pixels it becomes.
  camera.cx = scale * (camera.cx + 0.5) - 0.5;
  camera.cy = scale * (camera.cy + 0.5) - 0.5;
}

/// A recording that is played, and what it says of objects.
struct Recording {
  occusg::SequenceReader sequence;
  occusg_ros::RecordedDetections objects;

  explicit Recording(const std::string& folder) : sequence(folder), objects(sequence) {}
};

/// What a frame is sent as.
struct PlayedFrame {
  FrameMessages messages;
  std::optional<occusg::DetectionArray> detections;
};

/// Where recorded times lie among those that are sent: under a clock of its own a replay keeps the
/// recorded distances and the clock runs faster, under the clock of the wall the distances shrink.
struct TimeAxis {
  double start_s = kFirstStamp_s;
  double speed = 1.0;       ///< Recorded seconds in one second of a stamp.
  double clock_rate = 1.0;  ///< Seconds of a stamp in one of the wall.

  [[nodiscard]] ros::Time at(double recorded_s) const {
    return ros::Time(start_s + recorded_s / speed);
  }
};

/// Frame `index`; empty, and said, when it cannot be read.
std::optional<PlayedFrame> read(const Recording& recording, std::size_t index, const TimeAxis& time,
                                const Options& options) {
  try {
    occusg::Frame frame = recording.sequence.read(index);
    if (!options.with_color) frame.color_path.reset();
    const ros::Time stamp = time.at(frame.stamp_s);
    PlayedFrame played;
    if (!options.detections.empty())
      played.detections = recording.objects.of(frame, stamp, options.frames.map);
    enlarge(frame, options.scale);
    played.messages = messagesOf(frame, stamp, options.frames);
    return played;
  } catch (const occusg::Error& error) {
    std::cerr << "occusg_play: skipped: " << error.what() << '\n';
    return std::nullopt;
  }
}

void writeBag(const Recording& recording, const Options& options) {
  rosbag::Bag bag(options.bag, rosbag::bagmode::Write);
  bag.setCompression(rosbag::compression::LZ4);
  const std::string ns = "/" + options.camera;
  for (std::size_t i = 0; i < recording.sequence.size(); ++i) {
    const auto played = read(recording, i, TimeAxis{}, options);
    if (!played) continue;
    const FrameMessages& messages = played->messages;
    const ros::Time stamp = messages.depth.header.stamp;
    bag.write("/tf", stamp, messages.tf);
    bag.write("/odom", stamp, messages.odometry);
    bag.write(ns + "/depth/camera_info", stamp, messages.info);
    bag.write(ns + "/depth/image_rect", stamp, messages.depth);
    if (messages.color) bag.write(ns + "/rgb/image_rect_color", stamp, *messages.color);
    if (played->detections) bag.write(options.detections, stamp, *played->detections);
  }
  const std::size_t frames = recording.sequence.size();
  std::cout << "wrote " << frames << (frames == 1 ? " frame to " : " frames to ") << options.bag
            << '\n';
}

Publishers advertise(ros::NodeHandle& nh, const Options& options, bool has_objects) {
  constexpr std::uint32_t kQueue = 100;
  const std::string ns = "/" + options.camera;
  Publishers publishers;
  if (options.clock) publishers.clock = nh.advertise<rosgraph_msgs::Clock>("/clock", kQueue);
  publishers.tf = nh.advertise<tf2_msgs::TFMessage>("/tf", kQueue);
  publishers.odometry = nh.advertise<nav_msgs::Odometry>("/odom", kQueue);
  publishers.info = nh.advertise<sensor_msgs::CameraInfo>(ns + "/depth/camera_info", kQueue);
  publishers.depth = nh.advertise<sensor_msgs::Image>(ns + "/depth/image_rect", kQueue);
  if (options.with_color)
    publishers.color = nh.advertise<sensor_msgs::Image>(ns + "/rgb/image_rect_color", kQueue);
  if (has_objects && !options.detections.empty())
    publishers.detections = nh.advertise<occusg::DetectionArray>(options.detections, kQueue);
  return publishers;
}

void publishClock(const Publishers& publishers, double stamp_s) {
  if (!publishers.clock) return;
  rosgraph_msgs::Clock clock;
  clock.clock = ros::Time(stamp_s);
  publishers.clock.publish(clock);
}

void publish(const Publishers& publishers, const PlayedFrame& played) {
  const FrameMessages& messages = played.messages;
  publishClock(publishers, messages.depth.header.stamp.toSec());
  publishers.tf.publish(messages.tf);
  publishers.odometry.publish(messages.odometry);
  publishers.info.publish(messages.info);
  publishers.depth.publish(messages.depth);
  if (messages.color && publishers.color) publishers.color.publish(*messages.color);
  if (played.detections && publishers.detections) publishers.detections.publish(*played.detections);
}

/// Lets the wall run until a stamp's time has come.
class Pace {
 public:
  Pace(const Publishers& publishers, const TimeAxis& time) : publishers_(publishers), time_(time) {}

  void waitUntil(double until_s) const {
    while (ros::ok() && now() < until_s - 1e-9) {
      ros::WallDuration(std::min(kClockStep_s, (until_s - now()) / time_.clock_rate)).sleep();
      publishClock(publishers_, std::min(now(), until_s));
    }
  }

  /// A player that is late has the time of a stamp now: what follows takes as long as it should.
  void restartAt(double stamp_s) {
    begun_ = ros::WallTime::now() - ros::WallDuration((stamp_s - time_.start_s) / time_.clock_rate);
  }

 private:
  [[nodiscard]] double now() const {
    return time_.start_s + (ros::WallTime::now() - begun_).toSec() * time_.clock_rate;
  }

  const Publishers& publishers_;
  TimeAxis time_;
  ros::WallTime begun_ = ros::WallTime::now();
};

void stand(const Publishers& publishers, FrameMessages messages, const Options& options,
           Pace pace) {
  const double arrived_s = messages.depth.header.stamp.toSec();
  // Without it a late player would publish no clock here. Stamps of the wall's clock stay as they
  // are.
  if (options.clock) pace.restartAt(arrived_s);
  for (double waited_s = kStandStep_s; ros::ok() && waited_s <= options.hold_s;
       waited_s += kStandStep_s) {
    pace.waitUntil(arrived_s + waited_s);
    for (geometry_msgs::TransformStamped& transform : messages.tf.transforms)
      transform.header.stamp = ros::Time(arrived_s + waited_s);
    messages.odometry.header.stamp = ros::Time(arrived_s + waited_s);
    publishers.tf.publish(messages.tf);
    publishers.odometry.publish(messages.odometry);
  }
}

void playOnce(const Recording& recording, const Publishers& publishers, const Options& options) {
  TimeAxis time;
  if (options.clock) {
    time.clock_rate = options.rate;
  } else {
    time.start_s = ros::WallTime::now().toSec();
    time.speed = options.rate;
  }
  const Pace pace(publishers, time);
  std::optional<FrameMessages> last;
  for (std::size_t i = 0; ros::ok() && i < recording.sequence.size(); ++i) {
    const auto played = read(recording, i, time, options);
    if (!played) continue;
    pace.waitUntil(played->messages.depth.header.stamp.toSec());
    publish(publishers, *played);
    last = played->messages;
  }
  if (last) stand(publishers, *last, options, pace);
}

void play(const Recording& recording, const Options& options) {
  ros::NodeHandle nh;
  const Publishers publishers = advertise(nh, options, recording.objects.any());
  const ros::WallTime start = ros::WallTime::now();
  while (ros::ok() && options.wait && publishers.depth.getNumSubscribers() == 0 &&
         (ros::WallTime::now() - start).toSec() < kPatience_s)
    ros::WallDuration(0.1).sleep();
  // Connections are made one after the other; what is sent before the last is lost.
  ros::WallDuration(1.0).sleep();
  do {
    playOnce(recording, publishers, options);
  } while (ros::ok() && options.loop);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    ros::init(argc, argv, "occusg_play");
    ros::Time::init();
    Options options;
    if (!parse(argc, argv, options)) return 0;
    const Recording recording(options.sequences.front());
    if (options.bag.empty()) {
      play(recording, options);
    } else {
      writeBag(recording, options);
    }
  } catch (const std::exception& error) {
    std::cerr << "occusg_play: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
