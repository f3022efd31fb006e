// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "occusg/perception/depth_frame.hpp"

namespace occusg::testing {

/// The frames of the project's own recording, for floors below the reader of recordings. It is
/// trusted: what a reader must refuse is not looked for.
class RecordedFrames {
 public:
  explicit RecordedFrames(std::string folder = OCCUSG_TEST_RECORDING) : folder_(std::move(folder)) {
    std::map<double, Pose> poses;
    forEachLine("groundtruth.txt", [&](std::istream& line) {
      double stamp_s = 0.0;
      Eigen::Vector3d t = Eigen::Vector3d::Zero();
      Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
      line >> stamp_s >> t.x() >> t.y() >> t.z() >> q.x() >> q.y() >> q.z() >> q.w();
      poses[stamp_s].linear() = q.normalized().toRotationMatrix();
      poses[stamp_s].translation() = t;
    });
    forEachLine("depth.txt", [&](std::istream& line) {
      double stamp_s = 0.0;
      std::string path;
      line >> stamp_s >> path;
      const auto pose = poses.find(stamp_s);
      if (pose != poses.end()) frames_.push_back({stamp_s, path, pose->second});
    });
  }

  [[nodiscard]] std::size_t size() const { return frames_.size(); }

  [[nodiscard]] DepthFrame at(std::size_t index) const {
    const Entry& entry = frames_[index];
    DepthFrame frame;
    frame.stamp_s = entry.stamp_s;
    frame.depth.pixels = cv::imread(folder_ + "/" + entry.path, cv::IMREAD_UNCHANGED);
    frame.camera = {320, 240, 168.60482004495398, 168.60482004495398, 159.5, 119.5};
    frame.T_map_camera = entry.T_map_camera;
    return frame;
  }

 private:
  struct Entry {
    double stamp_s = 0.0;
    std::string path;
    Pose T_map_camera;
  };

  template <typename Visit>
  void forEachLine(const std::string& name, Visit&& visit) const {
    std::ifstream file(folder_ + "/" + name);
    for (std::string text; std::getline(file, text);) {
      if (text.empty() || text.front() == '#') continue;
      std::istringstream line(text);
      visit(line);
    }
  }

  std::string folder_;
  std::vector<Entry> frames_;
};

}  // namespace occusg::testing
