// SPDX-License-Identifier: BSD-3-Clause
#include "io/portable_map.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>

#include "io/file_bytes.hpp"
#include "io/picture_size.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr int kMaxValue = 65535;

/// The words of a header and, in a plain file, the pixels.
class Words {
 public:
  Words(const std::string& bytes, std::size_t start) : bytes_(bytes), at_(start) {}

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
  /// The next bit of a plain bit map, whose digits need no blanks between them.
  std::optional<int> bit() {
    skipBlanks();
    if (at_ == bytes_.size() || (bytes_[at_] != '0' && bytes_[at_] != '1')) return std::nullopt;
    return bytes_[at_++] - '0';
  }
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] bool isAtEnd() const { return at_ >= bytes_.size(); }

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

struct Header {
  char kind = '5';  ///< '1' to '6'.
  int width = 0;
  int height = 0;
  int largest = 1;
  std::size_t end = 0;  ///< Just behind the last number.

  [[nodiscard]] bool isBits() const { return kind == '1' || kind == '4'; }
  [[nodiscard]] int channels() const { return kind == '3' || kind == '6' ? 3 : 1; }
  [[nodiscard]] std::size_t values() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(channels());
  }
  [[nodiscard]] std::uint8_t scaled(int value) const {
    return static_cast<std::uint8_t>(largest == 255 ? value
                                                    : (value * 255 + largest / 2) / largest);
  }
};

Header headerOf(const std::string& bytes, std::size_t max_pixels, const std::string& path) {
  constexpr const char* kRight = "width, height and largest value are needed";
  Header header;
  header.kind = bytes[1];
  Words words(bytes, 2);
  const auto width = words.number();
  const auto height = words.number();
  const auto largest = header.isBits() ? std::optional<int>(1) : words.number();
  if (!width || !height || !largest)
    throw refuse(path, "has no readable header of a portable map", kRight);
  checkPictureSize({*width, *height}, max_pixels, path);
  if (*largest < 1 || *largest > kMaxValue) {
    throw refuse(path, "has " + std::to_string(*largest) + " as its largest value",
                 "a number from 1 to " + std::to_string(kMaxValue) + " is needed");
  }
  header.width = *width;
  header.height = *height;
  header.largest = *largest;
  header.end = words.position();
  return header;
}

[[noreturn]] void refuseShort(const std::string& path, const Header& header) {
  throw refuse(path, "ends before its last pixel",
               "a complete picture of " + std::to_string(header.width) + " x " +
                   std::to_string(header.height) + " pixels is needed");
}

cv::Mat emptyPicture(const Header& header) {
  return cv::Mat(header.height, header.width, CV_8UC(header.channels()));
}

/// Bytes from `end` on, 0 when all of them are blanks.
std::size_t leftOver(const std::string& bytes, std::size_t end) {
  const bool all_blank = std::all_of(bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end(),
                                     [](unsigned char c) { return std::isspace(c) != 0; });
  return all_blank ? 0 : bytes.size() - end;
}

PortableMap binaryBits(const std::string& bytes, const Header& header, const std::string& path) {
  const std::size_t start = header.end + 1;
  const std::size_t row_bytes = (static_cast<std::size_t>(header.width) + 7) / 8;
  const std::size_t end = start + row_bytes * static_cast<std::size_t>(header.height);
  if (bytes.size() < end) refuseShort(path, header);
  cv::Mat pixels = emptyPicture(header);
  for (int row = 0; row < header.height; ++row) {
    const char* source = bytes.data() + start + static_cast<std::size_t>(row) * row_bytes;
    auto* target = pixels.ptr<std::uint8_t>(row);
    for (int x = 0; x < header.width; ++x) {
      const auto byte = static_cast<unsigned char>(source[x / 8]);
      target[x] = ((byte >> (7 - x % 8)) & 1U) != 0 ? 0 : 255;
    }
  }
  return {pixels, 0, header.largest, leftOver(bytes, end)};
}

PortableMap binaryValues(const std::string& bytes, const Header& header, const std::string& path) {
  const std::size_t start = header.end + 1;
  const std::size_t value_bytes = header.largest > 255 ? 2 : 1;
  if (bytes.size() < start || bytes.size() - start < header.values() * value_bytes)
    refuseShort(path, header);
  const std::size_t end = start + header.values() * value_bytes;
  PortableMap map{emptyPicture(header), 0, header.largest, leftOver(bytes, end)};
  auto* target = map.pixels.ptr<std::uint8_t>();
  const auto* source = reinterpret_cast<const unsigned char*>(bytes.data()) + start;
  for (std::size_t i = 0; i < header.values(); ++i, source += value_bytes) {
    const int value = value_bytes == 1 ? source[0] : 256 * source[0] + source[1];
    map.clipped_values += value > header.largest ? 1U : 0U;
    target[i] = header.scaled(std::min(value, header.largest));
  }
  return map;
}

cv::Mat plainValues(const std::string& bytes, const Header& header, const std::string& path) {
  cv::Mat pixels = emptyPicture(header);
  Words words(bytes, header.end);
  auto* target = pixels.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < header.values(); ++i) {
    const auto value = header.isBits() ? words.bit() : words.number();
    if (!value && words.isAtEnd()) refuseShort(path, header);
    if (!value) {
      throw refuse(path, "has a pixel that is no number: pixel " + std::to_string(i + 1),
                   "whole numbers of up to nine digits are needed");
    }
    if (*value > header.largest) {
      throw refuse(path, "has a pixel of value " + std::to_string(*value),
                   "values from 0 to " + std::to_string(header.largest) + " are needed");
    }
    target[i] = header.isBits() ? (*value != 0 ? 0 : 255) : header.scaled(*value);
  }
  return pixels;
}

}  // namespace

PortableMap readPortableMap(const std::string& path, const std::string& beginning,
                            std::size_t max_pixels) {
  const Header header = headerOf(beginning, max_pixels, path);
  // A plain value is up to five digits, a blank, and perhaps a line end.
  const std::size_t max_bytes = 7 * header.values() + (std::size_t{1} << 20U);
  const std::string bytes = readFile(path, max_bytes);
  if (header.kind > '4') return binaryValues(bytes, header, path);
  if (header.kind == '4') return binaryBits(bytes, header, path);
  return {plainValues(bytes, header, path), 0, header.largest, 0};
}

}  // namespace occusg
