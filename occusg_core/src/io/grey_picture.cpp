// SPDX-License-Identifier: BSD-3-Clause
#include "io/grey_picture.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <vector>

#include "occusg/error.hpp"
#include "occusg/io/file_bytes.hpp"
#include "occusg/io/png_check.hpp"

namespace occusg {
namespace {

constexpr const char* kGreyIsNeeded = "an 8-bit grey PGM or PNG is needed";
/// A picture's size stands within so many bytes, comments of a PGM included.
constexpr std::size_t kHeaderBytes = 4096;
constexpr int kMaxSide = 1'000'000;  ///< What OpenCV decodes ends a little above.

void checkSize(std::int64_t width, std::int64_t height, std::size_t max_pixels,
               const std::string& path) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    throw refuse(path, "is " + size + " pixels",
                 "sides from 1 to " + std::to_string(kMaxSide) + " are read");
  }
  const auto pixels = static_cast<std::uint64_t>(width * height);
  if (pixels <= max_pixels) return;
  throw refuse(path, "has " + size + " = " + std::to_string(pixels) + " cells",
               "at most " + std::to_string(max_pixels) + " are read (--max-cells raises that)");
}

/// The words of a portable grey map's header and, in a plain one, its pixels.
class PgmWords {
 public:
  PgmWords(const std::string& bytes, std::size_t start) : bytes_(bytes), at_(start) {}

  /// The next number; nothing where there is none or it has more than nine digits.
  std::optional<int> number() {
    skipBlanks();
    const std::size_t start = at_;
    int value = 0;
    while (at_ < bytes_.size() && std::isdigit(static_cast<unsigned char>(bytes_[at_])) != 0) {
      if (at_ - start == 9) return std::nullopt;
      value = 10 * value + (bytes_[at_++] - '0');
    }
    return at_ == start ? std::nullopt : std::optional<int>(value);
  }
  [[nodiscard]] std::size_t position() const { return at_; }

 private:
  void skipBlanks() {
    while (at_ < bytes_.size()) {
      if (bytes_[at_] == '#') {
        at_ = std::min(bytes_.find('\n', at_), bytes_.size());
      } else if (std::isspace(static_cast<unsigned char>(bytes_[at_])) != 0) {
        ++at_;
      } else {
        return;
      }
    }
  }

  const std::string& bytes_;
  std::size_t at_;
};

struct PgmHeader {
  int width = 0;
  int height = 0;
  std::size_t end = 0;  ///< Just behind the largest value.
};

PgmHeader pgmHeader(const std::string& bytes, std::size_t max_pixels, const std::string& path) {
  PgmWords words(bytes, 2);
  const auto width = words.number();
  const auto height = words.number();
  const auto largest = words.number();
  if (!width || !height || !largest)
    throw refuse(path, "has no readable PGM header", kGreyIsNeeded);
  checkSize(*width, *height, max_pixels, path);
  if (*largest > 255) throw refuse(path, "is a 16-bit picture", kGreyIsNeeded);
  if (*largest != 255) {
    throw refuse(path, "has " + std::to_string(*largest) + " as its largest grey",
                 "a PGM from 0 to 255 is needed");
  }
  return {*width, *height, words.position()};
}

[[noreturn]] void refuseShort(const std::string& path, const PgmHeader& header) {
  throw refuse(path, "ends before its last pixel",
               "a complete picture of " + std::to_string(header.width) + " x " +
                   std::to_string(header.height) + " pixels is needed");
}

cv::Mat binaryPgm(const std::string& bytes, const PgmHeader& header, const std::string& path) {
  const std::size_t start = header.end + 1;
  const auto count =
      static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
  if (bytes.size() < start || bytes.size() - start < count) refuseShort(path, header);
  cv::Mat pixels(header.height, header.width, CV_8UC1);
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(start), count,
              pixels.ptr<std::uint8_t>());
  return pixels;
}

cv::Mat plainPgm(const std::string& bytes, const PgmHeader& header, const std::string& path) {
  cv::Mat pixels(header.height, header.width, CV_8UC1);
  PgmWords words(bytes, header.end);
  const auto count =
      static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
  std::uint8_t* target = pixels.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = words.number();
    if (!value) refuseShort(path, header);
    if (*value > 255) {
      throw refuse(path, "has a pixel of value " + std::to_string(*value),
                   "values from 0 to 255 are needed");
    }
    target[i] = static_cast<std::uint8_t>(*value);
  }
  return pixels;
}

cv::Mat readPgm(const std::string& path, const std::string& beginning, std::size_t max_pixels) {
  const PgmHeader header = pgmHeader(beginning, max_pixels, path);
  // A plain pixel is up to three digits, a blank, and perhaps a line end.
  const std::size_t max_bytes =
      5 * static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) +
      (std::size_t{1} << 20U);
  const std::string bytes = readFile(path, max_bytes);
  return beginning[1] == '5' ? binaryPgm(bytes, header, path) : plainPgm(bytes, header, path);
}

void checkIsGrey(const PngHeader& header, const std::string& path) {
  if (header.channels == 2) throw refuse(path, "is a grey picture with alpha", kGreyIsNeeded);
  if (header.channels > 2) throw refuse(path, "is a colour picture", kGreyIsNeeded);
  if (header.bit_depth > 8) throw refuse(path, "is a 16-bit picture", kGreyIsNeeded);
}

std::uint32_t bigEndian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    value = (value << 8U) | static_cast<unsigned char>(bytes[i]);
  return value;
}

cv::Mat readPng(const std::string& path, const std::string& beginning, std::size_t max_pixels) {
  constexpr std::size_t kSizeAt = 16;
  if (beginning.size() >= kSizeAt + 8) {
    checkSize(bigEndian(beginning, kSizeAt), bigEndian(beginning, kSizeAt + 4), max_pixels, path);
  }
  // Compressed data is never much longer than the pixels; the rest is for colours and texts.
  const std::string bytes = readFile(path, 8 * max_pixels + (std::size_t{16} << 20U));
  const PngHeader header = checkPng(bytes, path, kMaxSide);
  checkIsGrey(header, path);
  const std::vector<unsigned char> buffer(bytes.begin(), bytes.end());
  cv::Mat pixels;
  try {
    pixels = cv::imdecode(buffer, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    pixels = cv::Mat();
  }
  if (pixels.type() != CV_8UC1 || pixels.cols != header.width || pixels.rows != header.height)
    throw refuse(path, "cannot be decoded", "a complete PNG is needed");
  return pixels;
}

}  // namespace

cv::Mat readGreyPicture(const std::string& path, std::size_t max_pixels) {
  const std::string beginning = readBeginning(path, kHeaderBytes);
  const std::string magic = beginning.substr(0, 2);
  if (magic == "\x89P") return readPng(path, beginning, max_pixels);
  if (magic == "P5" || magic == "P2") return readPgm(path, beginning, max_pixels);
  if (magic == "P6" || magic == "P3") throw refuse(path, "is a colour picture", kGreyIsNeeded);
  throw refuse(path, beginning.empty() ? "is empty" : "is neither a PGM nor a PNG", kGreyIsNeeded);
}

}  // namespace occusg
