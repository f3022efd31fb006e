// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace occusg {

/// CPU time of the calling thread [s]: what other programs take does not count.
inline double threadTime() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace occusg
