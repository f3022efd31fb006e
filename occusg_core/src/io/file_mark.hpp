// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "occusg/io/output_folder.hpp"

namespace occusg {

[[nodiscard]] FileMark markOf(std::string_view bytes);

/// The checksum that a file states in decimal digits.
/// @return false when the text is no such number; `checksum` is untouched then.
[[nodiscard]] bool parseChecksum(const std::string& text, std::uint64_t& checksum);

}  // namespace occusg
