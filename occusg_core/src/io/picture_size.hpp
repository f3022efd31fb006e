// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace occusg {

enum class PictureKind { kUnknown, kPng, kPortableMap, kBmp, kJpeg };

/// The kind of a picture by its first bytes.
[[nodiscard]] PictureKind pictureKind(const std::string& bytes);

struct PictureSize {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// The size in the header of a PNG, BMP or JPEG, which is all that is looked at. Zero where it is
/// not found.
[[nodiscard]] PictureSize pictureSize(const std::string& bytes, PictureKind kind);

/// @throws Error naming `path` when a side is not within what is decoded, or there are more than
/// `max_pixels`.
void checkPictureSize(const PictureSize& size, std::size_t max_pixels, const std::string& path);

/// Longest side that is decoded [pixels].
inline constexpr int kMaxPictureSide = 1'000'000;

}  // namespace occusg
