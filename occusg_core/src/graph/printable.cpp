// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/printable.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace occusg {
namespace {

struct Decoded {
  std::uint32_t character = 0;
  std::size_t bytes = 0;
};

/// The character that begins at `at`; empty when there is none in its shortest form.
std::optional<Decoded> characterAt(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  Decoded decoded{first, 1};
  std::uint32_t smallest = 0;
  if (first >= 0x80U) {
    if (first >= 0xC0U && first < 0xE0U) {
      decoded = {first & 0x1FU, 2};
      smallest = 0x80U;
    } else if (first >= 0xE0U && first < 0xF0U) {
      decoded = {first & 0x0FU, 3};
      smallest = 0x800U;
    } else if (first >= 0xF0U && first < 0xF8U) {
      decoded = {first & 0x07U, 4};
      smallest = 0x10000U;
    } else {
      return std::nullopt;
    }
  }
  if (at + decoded.bytes > text.size()) return std::nullopt;
  for (std::size_t i = 1; i < decoded.bytes; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return std::nullopt;
    decoded.character = (decoded.character << 6U) | (byte(at + i) & 0x3FU);
  }
  if (decoded.character < smallest) return std::nullopt;
  return decoded;
}

bool isShown(std::uint32_t character) {
  const auto within = [character](std::uint32_t first, std::uint32_t last) {
    return character >= first && character <= last;
  };
  const bool is_control = character < 0x20U || within(0x7FU, 0x9FU);
  const bool is_surrogate = within(0xD800U, 0xDFFFU);
  const bool turns_or_breaks =
      within(0x200EU, 0x200FU) || within(0x2028U, 0x202EU) || within(0x2066U, 0x2069U);
  const bool is_none =
      character > 0x10FFFFU || (character & 0xFFFEU) == 0xFFFEU || character == 0xFEFFU;
  return !is_control && !is_surrogate && !turns_or_breaks && !is_none;
}

}  // namespace

bool isPrintableUtf8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::optional<Decoded> decoded = characterAt(text, at);
    if (!decoded || !isShown(decoded->character)) return false;
    at += decoded->bytes;
  }
  return true;
}

}  // namespace occusg
