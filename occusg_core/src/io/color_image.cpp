// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/color_image.hpp"

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/picture_size.hpp"
#include "occusg/error.hpp"

namespace occusg {

cv::Mat readColorImage(const std::string& path) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 29U;
  return decodeColorImage(readFile(path, kMaxBytes), path);
}

cv::Mat decodeColorImage(const std::string& bytes, const std::string& where) {
  constexpr std::size_t kMaxPixels = 100'000'000;
  const PictureKind kind = pictureKind(bytes);
  const bool has_known_size =
      kind == PictureKind::kPng || kind == PictureKind::kBmp || kind == PictureKind::kJpeg;
  if (has_known_size) checkPictureSize(pictureSize(bytes, kind), kMaxPixels, where);
  const std::vector<unsigned char> buffer(bytes.begin(), bytes.end());
  cv::Mat pixels;
  try {
    if (!buffer.empty()) pixels = cv::imdecode(buffer, cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {  // a limit of the decoder
    pixels = cv::Mat();
  }
  if (pixels.empty())
    throw refuse(where, "cannot be decoded", "a complete colour image (PNG, JPEG) is needed");
  return pixels;
}

}  // namespace occusg
