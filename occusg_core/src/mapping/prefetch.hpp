// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace occusg {

/// Of most processors [bytes].
inline constexpr std::size_t kCacheLine = 64;

/// Asks for what is at an address, to have it in the cache when it is needed.
inline void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

}  // namespace occusg
