// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace occusg {

/// Size and content of a file, to tell a damaged one or one of another run.
struct FileMark {
  std::size_t bytes = 0;
  std::uint64_t checksum = 14'695'981'039'346'656'037U;  ///< FNV-1a, 64 bit (Fowler, Noll, Vo).

  /// Takes in the bytes that follow.
  void add(std::string_view more);
  [[nodiscard]] bool operator==(const FileMark& other) const {
    return bytes == other.bytes && checksum == other.checksum;
  }
};

[[nodiscard]] FileMark markOf(std::string_view bytes);

/// The checksum that a file states in decimal digits.
/// @return false when the text is no such number; `checksum` is untouched then.
[[nodiscard]] bool parseChecksum(const std::string& text, std::uint64_t& checksum);

}  // namespace occusg
