// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/png_check.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr const char* kComplete = "a complete PNG is needed";
constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kChunkFrameBytes = 12;  ///< Length, type and CRC around the data.

std::uint32_t bigEndian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    value = (value << 8U) | static_cast<unsigned char>(bytes[i]);
  return value;
}

std::array<std::uint32_t, 256> crcTable() {
  constexpr std::uint32_t kPolynomial = 0xEDB88320U;
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < table.size(); ++n) {
    std::uint32_t value = n;
    for (int bit = 0; bit < 8; ++bit)
      value = (value & 1U) != 0 ? kPolynomial ^ (value >> 1U) : value >> 1U;
    table[n] = value;
  }
  return table;
}

/// CRC-32 of ISO 3309, as PNG uses it.
std::uint32_t crc32(const std::string& bytes, std::size_t begin, std::size_t end) {
  static const std::array<std::uint32_t, 256> kTable = crcTable();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = begin; i < end; ++i)
    crc = kTable[(crc ^ static_cast<unsigned char>(bytes[i])) & 0xFFU] ^ (crc >> 8U);
  return crc ^ 0xFFFFFFFFU;
}

struct Chunk {
  std::string type;
  std::size_t data = 0;  ///< Offset of the first data byte.
  std::size_t length = 0;
};

Chunk chunkAt(const std::string& bytes, std::size_t at, const std::string& where) {
  const std::string truncated = "is truncated at byte " + std::to_string(bytes.size());
  if (bytes.size() - at < kChunkFrameBytes) throw refuse(where, truncated, kComplete);
  Chunk chunk{bytes.substr(at + 4, 4), at + 8, bigEndian(bytes, at)};
  if (bytes.size() - at - kChunkFrameBytes < chunk.length)
    throw refuse(where, truncated, kComplete);
  const std::size_t end = chunk.data + chunk.length;
  if (crc32(bytes, at + 4, end) != bigEndian(bytes, end)) {
    throw refuse(where,
                 "is damaged between byte " + std::to_string(at) + " and " +
                     std::to_string(end + 4) + " (CRC mismatch)",
                 kComplete);
  }
  return chunk;
}

int channelsOf(unsigned char color_type) {
  switch (color_type) {
    case 0:
      return 1;  // grey
    case 2:
    case 3:
      return 3;  // RGB, palette
    case 4:
      return 2;  // grey and alpha
    default:
      return 4;
  }
}

PngHeader headerOf(const std::string& bytes, const Chunk& chunk, const std::string& where,
                   int max_side) {
  constexpr std::size_t kHeaderBytes = 13;
  if (chunk.type != "IHDR" || chunk.length != kHeaderBytes)
    throw refuse(where, "does not begin with an image header", kComplete);
  const std::uint32_t width = bigEndian(bytes, chunk.data);
  const std::uint32_t height = bigEndian(bytes, chunk.data + 4);
  const auto limit = static_cast<std::uint32_t>(max_side);
  if (width < 1 || height < 1 || width > limit || height > limit) {
    throw refuse(where, "is " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                 "sides from 1 to " + std::to_string(max_side) + " are read");
  }
  return {static_cast<int>(width), static_cast<int>(height),
          static_cast<unsigned char>(bytes[chunk.data + 8]),
          channelsOf(static_cast<unsigned char>(bytes[chunk.data + 9]))};
}

}  // namespace

PngHeader checkPng(const std::string& bytes, const std::string& where, int max_side) {
  if (bytes.compare(0, kSignatureBytes, "\x89PNG\r\n\x1a\n", kSignatureBytes) != 0)
    throw refuse(where, bytes.empty() ? "is empty" : "is not a PNG", kComplete);
  Chunk chunk = chunkAt(bytes, kSignatureBytes, where);
  const PngHeader header = headerOf(bytes, chunk, where, max_side);
  while (chunk.type != "IEND") chunk = chunkAt(bytes, chunk.data + chunk.length + 4, where);
  return header;
}

}  // namespace occusg
