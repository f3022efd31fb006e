// SPDX-License-Identifier: BSD-3-Clause
#include "wall_clock.hpp"

#include <chrono>

namespace occusg::apps {

double latestCredibleStamp() {
  constexpr double kTolerance_s = 5.0;
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since_epoch).count() + kTolerance_s;
}

}  // namespace occusg::apps
