// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace occusg::testing {

/// Bytes the program has asked `operator new` for so far. Where it is linked, that is replaced.
[[nodiscard]] std::size_t allocatedBytes();

}  // namespace occusg::testing
