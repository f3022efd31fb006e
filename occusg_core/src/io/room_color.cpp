// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/io/room_color.hpp"

#include <algorithm>
#include <cmath>

namespace occusg {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGoldenRatio = 0.61803398874989485;

double labInverse(double t) {
  constexpr double kKnee = 6.0 / 29.0;
  return t > kKnee ? t * t * t : 3.0 * kKnee * kKnee * (t - 4.0 / 29.0);
}

std::uint8_t srgb(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  const double encoded =
      value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

}  // namespace

RgbColor roomColor(int id, const ColorTone& tone) {
  // The offset puts the first rooms on blue, orange and green.
  const double turns = 0.15 + id * kGoldenRatio;
  const double hue = 2.0 * kPi * (turns - std::floor(turns));
  const double fy = (tone.lightness + 16.0) / 116.0;
  const double x = 0.95047 * labInverse(fy + tone.chroma * std::cos(hue) / 500.0);
  const double y = labInverse(fy);
  const double z = 1.08883 * labInverse(fy - tone.chroma * std::sin(hue) / 200.0);
  return {srgb(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
          srgb(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
          srgb(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
}

}  // namespace occusg
