// SPDX-License-Identifier: BSD-3-Clause
// Takes a bag through the pipeline as fast as it goes: the same files as `occusg run` leaves.
#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>
#include <tf2_msgs/TFMessage.h>

#include <boost/program_options.hpp>
#include <deque>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/graph/graph_query.hpp"
#include "occusg/io/output_folder.hpp"
#include "occusg/io/results.hpp"
#include "occusg/perception/class_names.hpp"
#include "occusg/perception/onnx_segmenter.hpp"
#include "occusg/pipeline/config_file.hpp"
#include "occusg/regions/no_rooms.hpp"
#include "occusg_ros/compressed_depth.hpp"
#include "occusg_ros/image_conversions.hpp"
#include "occusg_ros/input_health.hpp"
#include "occusg_ros/orientation_check.hpp"
#include "occusg_ros/recent_colors.hpp"
#include "occusg_ros/tf_poses.hpp"
#include "tool_options.hpp"

namespace {

namespace po = boost::program_options;
using occusg_ros::Drop;
using occusg_ros::InputHealth;
using occusg_ros::PoseAnswer;

// Images that wait for the transform of their time; tf in a bag comes a little late at most.
constexpr std::size_t kMaxWaiting = 100;
constexpr double kTfCache_s = 60.0;

struct Options {
  std::vector<std::string> bags;
  std::string output;
  std::string config = "default";
  std::string depth_topic;
  std::string info_topic;
  std::string map_frame = "map";
  double depth_units_per_m = occusg_ros::kMillimetresPerMetre;
  std::string model;
  std::string classes;
  std::string color_topic;
};

bool parse(int argc, char** argv, Options& options) {
  po::options_description named(
      "occusg_bag BAG... -o OUT [options]\n\n"
      "Takes the depth images of a bag, or of several that were recorded as one, through the "
      "whole\n"
      "pipeline, as fast as it goes, and writes the files `occusg run` writes. Depth images may "
      "be\n"
      "plain or of the transports compressedDepth and compressed. With --model objects are found\n"
      "in the colour images, which must be registered to the depth images.\n\nOptions");
  named.add_options()("output,o", po::value(&options.output),
                      "folder for the results; created when missing")(
      "config", po::value(&options.config), "'default', 'paper' or a YAML file")(
      "depth", po::value(&options.depth_topic),
      "topic of the depth images; needed when the bag has several")(
      "info", po::value(&options.info_topic), "topic of their camera_info; else beside them")(
      "map-frame", po::value(&options.map_frame), "frame of the map")(
      "depth-scale", po::value(&options.depth_units_per_m),
      "value of one metre in 16-bit depth images: 1000, or 4000 for an L515, 5000 for TUM's")(
      "model", po::value(&options.model), "ONNX segmentation model of the YOLO family")(
      "classes", po::value(&options.classes), "the model's class names, one a line")(
      "color", po::value(&options.color_topic),
      "topic of the colour images, plain or compressed; needed when the bag has several");
  if (!occusg_ros::parseToolOptions(argc, argv, named, options.bags)) return false;
  if (options.bags.empty() || options.output.empty())
    throw occusg::Error("name a bag and, with -o, a folder for the results; see --help");
  if (!(options.depth_units_per_m >= 1.0 && options.depth_units_per_m <= 1e6)) {
    throw occusg::refuse("--depth-scale", "is " + std::to_string(options.depth_units_per_m),
                         "a number from 1 to 1000000 is needed");
  }
  if (options.model.empty() != options.classes.empty()) {
    throw occusg::refuse(options.model.empty() ? "--classes" : "--model", "stands alone",
                         "a model and its class names go together");
  }
  return true;
}

using Bags = std::vector<std::unique_ptr<rosbag::Bag>>;

/// @throws occusg::Error naming the bag and what to do, for one that was not closed.
Bags openedBags(const std::vector<std::string>& paths) {
  Bags bags;
  for (const std::string& path : paths) {
    try {
      bags.push_back(std::make_unique<rosbag::Bag>(path, rosbag::bagmode::Read));
    } catch (const rosbag::BagUnindexedException&) {
      throw occusg::refuse(path, "it has no index: its recording was cut off",
                           "'rosbag reindex " + path + "' mends it");
    } catch (const rosbag::BagException& error) {
      throw occusg::refuse(path, std::string("it cannot be read (") + error.what() + ")",
                           "a bag of format 2.0 is needed");
    }
  }
  return bags;
}

bool isImage(const std::string& type) {
  return type == "sensor_msgs/Image" || type == "sensor_msgs/CompressedImage";
}

bool isCameraInfo(const std::string& type) { return type == "sensor_msgs/CameraInfo"; }

enum class Picture { kDepth, kColor };

bool isOf(Picture picture, const std::string& topic) {
  const auto has = [&topic](const char* word) { return topic.find(word) != std::string::npos; };
  return picture == Picture::kDepth ? has("depth") : (has("rgb") || has("color")) && !has("depth");
}

/// Topics with the types of their messages.
using Topics = std::map<std::string, std::string>;

Topics topicsIn(const Bags& bags, bool (*is_wanted)(const std::string& type)) {
  Topics topics;
  for (const auto& bag : bags) {
    for (const rosbag::ConnectionInfo* connection : rosbag::View(*bag).getConnections())
      if (is_wanted(connection->datatype)) topics[connection->topic] = connection->datatype;
  }
  return topics;
}

std::string listOf(const Topics& topics) {
  std::string list;
  for (const auto& entry : topics) list += (list.empty() ? "" : ", ") + entry.first;
  return list;
}

/// @param what the messages that the topic must have.
/// @param option names the topic.
void requireTopic(const std::string& topic, const Topics& topics, const Bags& bags,
                  const std::string& what, const std::string& option) {
  if (topics.count(topic) > 0) return;
  throw occusg::refuse(bags.front()->getFileName(), "has no " + what + " on " + topic,
                       topics.empty() ? "it has none on any topic"
                                      : "it has " + what + " on " + listOf(topics) + " (" + option +
                                            " names the topic)");
}

/// The only topic of images that calls itself depth, or colour; a plain one goes before a
/// compressed one.
std::string topicOf(Picture picture, const Topics& images, const Bags& bags) {
  std::set<std::string> plain;
  std::set<std::string> compressed;
  for (const auto& [topic, type] : images)
    if (isOf(picture, topic)) (type == "sensor_msgs/Image" ? plain : compressed).insert(topic);
  if (plain.size() == 1) return *plain.begin();
  if (plain.empty() && compressed.size() == 1) return *compressed.begin();
  const std::string list = listOf(images);
  throw occusg::refuse(bags.front()->getFileName(),
                       list.empty() ? "it has no images" : "its topics of images are " + list,
                       picture == Picture::kDepth
                           ? "name the one with depth, as in --depth /camera/depth/image_rect"
                           : "name the one with colour, as in --color /camera/rgb/image_color");
}

/// Where the camera_info of a topic is by convention: beside the plain images.
std::string infoTopicOf(std::string depth_topic) {
  for (const std::string transport : {"/compressedDepth", "/compressed"}) {
    const std::size_t at = depth_topic.rfind(transport);
    if (at != std::string::npos && at + transport.size() == depth_topic.size())
      depth_topic.erase(at);
  }
  return depth_topic.substr(0, depth_topic.rfind('/')) + "/camera_info";
}

std::unique_ptr<occusg::OnnxSegmenter> segmenterFor(const Options& options,
                                                    occusg::OnnxSegmenterConfig config) {
  if (options.model.empty()) return nullptr;
  config.model_path = options.model;
  config.class_names = occusg::readClassNames(options.classes);
  return std::make_unique<occusg::OnnxSegmenter>(config);
}

/// The pipeline behind the messages of a bag.
class BagRun {
 public:
  BagRun(const Options& options, occusg::Pipeline& pipeline)
      : options_(options),
        pipeline_(pipeline),
        tf_(ros::Duration(kTfCache_s)),
        segmenter_(segmenterFor(options, pipeline.config().segmenter)),
        colors_(options.color_topic) {}

  void run(const Bags& bags);
  [[nodiscard]] InputHealth::Counts counts() const { return health_.counts(); }
  /// What looks wrong with how the map lies; empty when nothing does.
  [[nodiscard]] std::string doubt() const { return orientation_.doubt(); }
  /// Depth images without a colour image of their time, of those that needed one.
  [[nodiscard]] std::size_t withoutColor() const { return without_color_; }
  [[nodiscard]] const std::string& colorProblem() const { return color_problem_; }

 private:
  struct Waiting {
    sensor_msgs::ImageConstPtr image;
    std::optional<occusg::CameraModel> camera;  ///< None: the bag's first is still to come.
  };

  void take(const rosbag::MessageInstance& message);
  void takeTransforms(const tf2_msgs::TFMessage& transforms, bool is_static);
  void takeCompressed(const sensor_msgs::CompressedImage& compressed);
  void takeImage(const sensor_msgs::ImageConstPtr& image);
  void takeColor(const rosbag::MessageInstance& message);
  /// What the model sees in the colour image of that time; nothing without one.
  [[nodiscard]] std::optional<occusg::InstanceMasks> masksAt(double stamp_s);
  enum class Patience { kWait, kGiveUp };
  void processWaiting(Patience patience);
  void process(const Waiting& waiting, const occusg::Pose& pose);

  const Options& options_;
  occusg::Pipeline& pipeline_;
  tf2::BufferCore tf_;
  InputHealth health_;
  occusg_ros::OrientationCheck orientation_;
  std::optional<occusg::CameraModel> camera_;
  std::string camera_problem_;  ///< Of the last camera_info; empty while there was none.
  std::deque<Waiting> waiting_;
  std::unique_ptr<occusg::OnnxSegmenter> segmenter_;  ///< Null without a model.
  occusg_ros::RecentColors colors_;
  std::size_t without_color_ = 0;
  std::string color_problem_;  ///< Of the last colour image that cannot be used.
};

void BagRun::run(const Bags& bags) {
  std::vector<std::string> names{"/tf", "/tf_static", options_.depth_topic, options_.info_topic};
  if (segmenter_) names.push_back(options_.color_topic);
  const rosbag::TopicQuery topics(names);
  rosbag::View view;
  for (const auto& bag : bags) view.addQuery(*bag, topics);
  for (const rosbag::MessageInstance& message : view) {
    take(message);
    processWaiting(Patience::kWait);
  }
  processWaiting(Patience::kGiveUp);
  pipeline_.finish();
}

void BagRun::takeColor(const rosbag::MessageInstance& message) {
  if (const auto image = message.instantiate<sensor_msgs::Image>()) {
    colors_.add(image);
  } else if (const auto compressed = message.instantiate<sensor_msgs::CompressedImage>()) {
    colors_.add(compressed);
  }
}

std::optional<occusg::InstanceMasks> BagRun::masksAt(double stamp_s) {
  if (!segmenter_) return std::nullopt;
  std::optional<cv::Mat> picture;
  try {
    picture = colors_.at(stamp_s);
  } catch (const occusg::Error& error) {
    color_problem_ = error.what();  // the depth image is used all the same
  }
  if (picture) return segmenter_->segment(*picture);
  ++without_color_;
  return std::nullopt;
}

void BagRun::take(const rosbag::MessageInstance& message) {
  if (segmenter_ && message.getTopic() == options_.color_topic) {
    takeColor(message);
  } else if (const auto transforms = message.instantiate<tf2_msgs::TFMessage>()) {
    takeTransforms(*transforms, message.getTopic() == "/tf_static");
  } else if (const auto info = message.instantiate<sensor_msgs::CameraInfo>()) {
    try {
      camera_ = occusg_ros::toCameraModel(*info, options_.info_topic);
    } catch (const occusg::Error& error) {
      camera_.reset();
      camera_problem_ = error.what();
    }
  } else if (const auto image = message.instantiate<sensor_msgs::Image>()) {
    takeImage(image);
  } else if (const auto compressed = message.instantiate<sensor_msgs::CompressedImage>()) {
    takeCompressed(*compressed);
  }
}

void BagRun::takeCompressed(const sensor_msgs::CompressedImage& compressed) {
  try {
    takeImage(boost::make_shared<const sensor_msgs::Image>(
        occusg_ros::decompressedDepth(compressed, options_.depth_topic)));
  } catch (const occusg::Error& error) {
    health_.noteReceived();
    health_.noteDropped(Drop::kImage, error.what());
  }
}

void BagRun::takeTransforms(const tf2_msgs::TFMessage& transforms, bool is_static) {
  for (const geometry_msgs::TransformStamped& transform : transforms.transforms) {
    try {
      tf_.setTransform(transform, "bag", is_static);
    } catch (const tf2::TransformException& error) {
      health_.noteDropped(Drop::kBadTransform, error.what());
    }
  }
}

void BagRun::takeImage(const sensor_msgs::ImageConstPtr& image) {
  health_.noteReceived();
  if (!camera_ && !camera_problem_.empty()) {
    health_.noteDropped(Drop::kCameraInfo, camera_problem_);
    return;
  }
  waiting_.push_back({image, camera_});
}

void BagRun::processWaiting(Patience patience) {
  while (!waiting_.empty()) {
    Waiting& first = waiting_.front();
    const bool may_wait = patience == Patience::kWait && waiting_.size() <= kMaxWaiting;
    // Messages of one time are in any order in a bag.
    if (!first.camera) first.camera = camera_;
    const std_msgs::Header& header = first.image->header;
    const PoseAnswer answer =
        occusg_ros::poseAt(tf_, options_.map_frame, header.frame_id, header.stamp);
    const bool is_late = !first.camera || answer.kind == PoseAnswer::Kind::kNotYet ||
                         (segmenter_ && colors_.mayStillCome(header.stamp.toSec()));
    if (is_late && may_wait) return;
    if (!first.camera) {
      health_.noteDropped(Drop::kCameraInfo, "no camera_info on " + options_.info_topic);
    } else if (answer.kind == PoseAnswer::Kind::kFound) {
      process(first, answer.T_target_source);
    } else {
      health_.noteDropped(Drop::kNoTransform, answer.problem);
    }
    waiting_.pop_front();
  }
}

void BagRun::process(const Waiting& waiting, const occusg::Pose& pose) {
  try {
    const occusg::DepthFrame frame{
        waiting.image->header.stamp.toSec(),
        occusg_ros::toDepthImage(*waiting.image, options_.depth_topic, options_.depth_units_per_m),
        waiting.camera.value(), pose};
    if (const auto masks = masksAt(frame.stamp_s)) {
      pipeline_.process(frame, *masks);
    } else {
      pipeline_.process(frame);
    }
    orientation_.add(frame);
    health_.noteUsed();
  } catch (const occusg::Error& error) {
    health_.noteDropped(Drop::kImage, error.what());
  }
}

void report(const InputHealth::Counts& counts, const occusg::Pipeline& pipeline,
            const std::string& folder) {
  std::cout << counts.used << " of " << counts.received << " images used, "
            << pipeline.graph().nodes(occusg::NodeType::kRoom).size() << " rooms; results are in "
            << folder << '\n';
  for (std::size_t i = 0; i < occusg_ros::kDropCount; ++i) {
    if (counts.dropped[i] == 0) continue;
    std::cerr << "  " << occusg_ros::nameOf(static_cast<Drop>(i)) << ": " << counts.dropped[i]
              << '\n';
  }
  if (!counts.last_problem.empty())
    std::cerr << "  the last problem: " << counts.last_problem << '\n';
}

/// Finds the topics that are not named. @throws occusg::Error for one the bags do not have.
void chooseTopics(const Bags& bags, Options& options) {
  const Topics images = topicsIn(bags, isImage);
  if (options.depth_topic.empty()) options.depth_topic = topicOf(Picture::kDepth, images, bags);
  requireTopic(options.depth_topic, images, bags, "images", "--depth");
  if (!options.model.empty()) {
    if (options.color_topic.empty()) options.color_topic = topicOf(Picture::kColor, images, bags);
    requireTopic(options.color_topic, images, bags, "images", "--color");
  }
  if (options.info_topic.empty()) options.info_topic = infoTopicOf(options.depth_topic);
  requireTopic(options.info_topic, topicsIn(bags, isCameraInfo), bags, "camera_info", "--info");
}

int process(Options options) {
  occusg::Pipeline pipeline(occusg::loadConfig(options.config));
  const Bags bags = openedBags(options.bags);
  chooseTopics(bags, options);
  occusg::checkResultsPlace(options.output);
  const occusg::OutputFolder folder(options.output);
  BagRun run(options, pipeline);
  run.run(bags);
  const std::string scene = std::filesystem::path(options.bags.front()).stem().string();
  writeResultFiles(folder, resultFiles(pipeline, scene, pipeline.times()));
  const InputHealth::Counts counts = run.counts();
  report(counts, pipeline, folder.path());
  if (run.withoutColor() > 0) {
    std::cerr << "occusg_bag: " << run.withoutColor()
              << " depth images have no usable colour image of " << options.color_topic
              << " within " << occusg_ros::RecentColors::kTolerance_s
              << " s; no objects were looked for in them\n";
    if (!run.colorProblem().empty())
      std::cerr << "  the last problem: " << run.colorProblem() << '\n';
  }
  if (pipeline.graph().nodes(occusg::NodeType::kRoom).empty()) {
    std::cerr << "occusg_bag: no rooms: "
              << whyNoRooms(pipeline.freeSpace(), smallestRegion_m2(pipeline.config())) << '\n';
  }
  for (const std::string& doubt : {run.doubt(), doubtOnLargestRoom(pipeline.graph())}) {
    if (!doubt.empty()) std::cerr << "occusg_bag: " << doubt << '\n';
  }
  return 2 * counts.used >= counts.received && counts.used > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    ros::Time::init();
    Options options;
    if (!parse(argc, argv, options)) return 0;
    return process(options);
  } catch (const std::exception& error) {
    std::cerr << "occusg_bag: " << error.what() << '\n';
    return 1;
  }
}
