// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace occusg::testing {

inline std::string pngOf(const cv::Mat& pixels) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", pixels, bytes);
  return {bytes.begin(), bytes.end()};
}

inline constexpr const char* kCameraJson =
    R"({"width": 8, "height": 6, "fx": 5.0, "fy": 5.5, "cx": 3.5, "cy": 2.5, "depth_scale": 5000})";

/// A sequence of 8 x 6 pixel images at 0.0, 0.2, 0.4, ... s, camera at (index, 0, 1) m, looking
/// along z; image `index` has the value 1000 + index everywhere.
class RecordedSequence {
 public:
  explicit RecordedSequence(int frames = 3) {
    std::string depth = "# timestamp filename\n";
    std::string poses = "# timestamp tx ty tz qx qy qz qw\n";
    for (int i = 0; i < frames; ++i) {
      const std::string stamp = std::to_string(i / 5) + "." + std::to_string(2 * (i % 5));
      depth += stamp + " depth/" + std::to_string(i) + ".png\n";
      poses += stamp + " " + std::to_string(i) + " 0 1 0 0 0 1\n";
      folder.write("depth/" + std::to_string(i) + ".png",
                   pngOf(cv::Mat(6, 8, CV_16UC1, cv::Scalar(1000 + i))));
    }
    folder.write("depth.txt", depth);
    folder.write("groundtruth.txt", poses);
    folder.write("camera.json", kCameraJson);
  }

  [[nodiscard]] const std::string& path() const { return folder.path(); }

  TemporaryFolder folder;
};

}  // namespace occusg::testing
