// SPDX-License-Identifier: BSD-3-Clause
#include "io/picture_size.hpp"

#include <cstdlib>

#include "occusg/error.hpp"

namespace occusg {
namespace {

enum class ByteOrder { kBig, kLittle };

/// The number in `count` bytes at `at`; 0 beyond the end.
std::uint32_t numberAt(const std::string& bytes, std::size_t at, std::size_t count,
                       ByteOrder order) {
  if (bytes.size() < at + count) return 0;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = order == ByteOrder::kBig ? at + i : at + count - 1 - i;
    value = (value << 8U) | static_cast<unsigned char>(bytes[place]);
  }
  return value;
}

PictureSize bmpSize(const std::string& bytes) {
  const auto width = static_cast<std::int32_t>(numberAt(bytes, 18, 4, ByteOrder::kLittle));
  const auto height = static_cast<std::int32_t>(numberAt(bytes, 22, 4, ByteOrder::kLittle));
  // A negative height says that the first row is on top.
  return {width, std::llabs(static_cast<std::int64_t>(height))};
}

/// From the first frame header (ITU-T T.81, B.2.2) behind the segments before it.
PictureSize jpegSize(const std::string& bytes) {
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (static_cast<unsigned char>(bytes[at]) != 0xFF) return {};
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xFF) {
      ++at;
      continue;
    }
    const bool is_frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (is_frame) {
      return {numberAt(bytes, at + 7, 2, ByteOrder::kBig),
              numberAt(bytes, at + 5, 2, ByteOrder::kBig)};
    }
    at += 2 + numberAt(bytes, at + 2, 2, ByteOrder::kBig);
  }
  return {};
}

}  // namespace

PictureKind pictureKind(const std::string& bytes) {
  if (bytes.compare(0, 4, "\x89PNG") == 0) return PictureKind::kPng;
  if (bytes.compare(0, 2, "BM") == 0) return PictureKind::kBmp;
  if (bytes.compare(0, 3, "\xFF\xD8\xFF") == 0) return PictureKind::kJpeg;
  if (bytes.size() >= 3 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6')
    return PictureKind::kPortableMap;
  return PictureKind::kUnknown;
}

PictureSize pictureSize(const std::string& bytes, PictureKind kind) {
  switch (kind) {
    case PictureKind::kPng:
      return {numberAt(bytes, 16, 4, ByteOrder::kBig), numberAt(bytes, 20, 4, ByteOrder::kBig)};
    case PictureKind::kBmp:
      return bmpSize(bytes);
    case PictureKind::kJpeg:
      return jpegSize(bytes);
    case PictureKind::kPortableMap:
    case PictureKind::kUnknown:
      break;
  }
  return {};
}

void checkPictureSize(const PictureSize& size, std::size_t max_pixels, const std::string& path) {
  const std::string shown = std::to_string(size.width) + " x " + std::to_string(size.height);
  if (size.width < 1 || size.height < 1 || size.width > kMaxPictureSide ||
      size.height > kMaxPictureSide) {
    throw refuse(path, "is " + shown + " pixels",
                 "sides from 1 to " + std::to_string(kMaxPictureSide) + " are read");
  }
  const auto pixels = static_cast<std::uint64_t>(size.width * size.height);
  if (pixels <= max_pixels) return;
  throw refuse(path, "has " + shown + " = " + std::to_string(pixels) + " cells",
               "at most " + std::to_string(max_pixels) + " are read (--max-cells raises that)");
}

}  // namespace occusg
