// SPDX-License-Identifier: BSD-3-Clause
#include "io/map_picture.hpp"

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "io/file_bytes.hpp"
#include "io/picture_size.hpp"
#include "io/portable_map.hpp"
#include "occusg/error.hpp"
#include "occusg/io/png_check.hpp"

namespace occusg {
namespace {

/// A picture's size stands within so many bytes, comments of a portable map included.
constexpr std::size_t kHeaderBytes = 4096;
/// The size of a BMP, and that of a PNG, ends there.
constexpr std::size_t kSizeEnd = 26;
constexpr const char* kPictureIsNeeded = "a PNG, PGM, PPM, PBM, BMP or JPEG is needed";

PictureSize sizeIn(const std::string& bytes, PictureKind kind, std::size_t max_pixels,
                   const std::string& path) {
  const PictureSize size = pictureSize(bytes, kind);
  const bool is_cut = bytes.size() < kSizeEnd || kind == PictureKind::kJpeg;
  if (is_cut && size.width == 0 && size.height == 0)
    throw refuse(path, "ends before it says its size", "a complete picture is needed");
  checkPictureSize(size, max_pixels, path);
  return size;
}

cv::Mat decoded(const std::string& path, const std::string& beginning, PictureKind kind,
                std::size_t max_pixels) {
  // A JPEG's size may stand behind its texts and thumbnails.
  if (kind != PictureKind::kJpeg) (void)sizeIn(beginning, kind, max_pixels, path);
  // Compressed data is never much longer than the pixels; the rest is for colours and texts.
  const std::string bytes = readFile(path, 8 * max_pixels + (std::size_t{16} << 20U));
  if (kind == PictureKind::kPng) (void)checkPng(bytes, path, kMaxPictureSide);
  const PictureSize size = sizeIn(bytes, kind, max_pixels, path);
  const std::vector<unsigned char> buffer(bytes.begin(), bytes.end());
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    pixels = cv::Mat();
  }
  if (pixels.empty() || pixels.cols != size.width || pixels.rows != size.height)
    throw refuse(path, "cannot be decoded", "a complete picture is needed");
  return pixels;
}

/// The eight highest bits, as SDL gives map_server.
std::uint8_t eightBits(const cv::Mat& pixels, int row, int i) {
  if (pixels.depth() == CV_16U)
    return static_cast<std::uint8_t>(pixels.ptr<std::uint16_t>(row)[i] >> 8U);
  return pixels.ptr<std::uint8_t>(row)[i];
}

MapPicture separated(const cv::Mat& pixels) {
  const int channels = pixels.channels();
  const int colours = channels == 2 || channels == 4 ? channels - 1 : channels;
  MapPicture picture{cv::Mat(pixels.rows, pixels.cols, CV_8UC1), {}, {}};
  if (colours != channels) picture.alpha.create(pixels.rows, pixels.cols, CV_8UC1);
  bool opaque = true;
  for (int row = 0; row < pixels.rows; ++row) {
    auto* grey = picture.grey.ptr<std::uint8_t>(row);
    for (int x = 0; x < pixels.cols; ++x) {
      int sum = 0;
      for (int channel = 0; channel < colours; ++channel)
        sum += eightBits(pixels, row, x * channels + channel);
      grey[x] = static_cast<std::uint8_t>(sum / colours);
      if (colours == channels) continue;
      const std::uint8_t alpha = eightBits(pixels, row, x * channels + colours);
      picture.alpha.ptr<std::uint8_t>(row)[x] = alpha;
      opaque = opaque && alpha == 255;
    }
  }
  if (opaque) picture.alpha.release();
  return picture;
}

/// The kind of picture that the file begins as.
PictureKind kindOf(const std::string& path, const std::string& beginning) {
  const PictureKind kind = pictureKind(beginning);
  if (kind != PictureKind::kUnknown) return kind;
  throw refuse(path, beginning.empty() ? "is empty" : "is no picture that is read",
               kPictureIsNeeded);
}

}  // namespace

void requirePicture(const std::string& path) {
  (void)kindOf(path, readBeginning(path, kHeaderBytes));
}

MapPicture readMapPicture(const std::string& path, std::size_t max_pixels) {
  const std::string beginning = readBeginning(path, kHeaderBytes);
  const PictureKind kind = kindOf(path, beginning);
  if (kind == PictureKind::kPortableMap) {
    const PortableMap map = readPortableMap(path, beginning, max_pixels);
    MapPicture picture = separated(map.pixels);
    if (map.clipped_values > 0) {
      picture.assumptions.push_back(
          std::to_string(map.clipped_values) + " of the picture's values " +
          (map.clipped_values == 1 ? "is" : "are") + " above " + std::to_string(map.largest) +
          ", the largest by its header; " + (map.clipped_values == 1 ? "it was" : "they were") +
          " read as that");
    }
    if (map.left_over_bytes > 0) {
      picture.assumptions.push_back(std::to_string(map.left_over_bytes) +
                                    (map.left_over_bytes == 1 ? " byte follows" : " bytes follow") +
                                    " the picture's last pixel and " +
                                    (map.left_over_bytes == 1 ? "was" : "were") + " left out");
    }
    return picture;
  }
  const cv::Mat pixels = decoded(path, beginning, kind, max_pixels);
  if (pixels.depth() != CV_8U && pixels.depth() != CV_16U)
    throw refuse(path, "has floating-point pixels", kPictureIsNeeded);
  return separated(pixels);
}

}  // namespace occusg
