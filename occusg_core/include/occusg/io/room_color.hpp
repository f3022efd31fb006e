// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace occusg {

/// A colour of 8 bits a channel.
struct RgbColor {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
};

/// How strong a colour is, in CIELAB: lightness 0..100, chroma from 0 (grey).
struct ColorTone {
  double lightness = 0.0;
  double chroma = 0.0;
};

/// Colour of a room by its id alone: hues a golden ratio of the circle apart, so that neighbouring
/// ids differ most; equal lightness and chroma, so that no room stands out (CIE 1976 L*a*b*, D65,
/// sRGB).
[[nodiscard]] RgbColor roomColor(int id, const ColorTone& tone);

}  // namespace occusg
