// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/perception/camera_model.hpp"

namespace occusg {

/// What a PNG says of itself (PNG specification, 3rd edition, 11.2.1).
struct PngHeader {
  int width = 0;
  int height = 0;
  int bit_depth = 0;
  int channels = 0;
};

/// Checks a PNG before anything decodes it: signature, every chunk complete and with the right
/// CRC-32, image header first, IEND last. A decoder may hand out part of a truncated picture as if
/// it were whole.
/// @param max_side longest side that is accepted [pixels].
/// @throws Error naming `where` and the byte at fault.
[[nodiscard]] PngHeader checkPng(const std::string& bytes, const std::string& where,
                                 int max_side = kMaxImageSide);

}  // namespace occusg
