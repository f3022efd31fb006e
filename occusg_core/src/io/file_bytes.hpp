// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace occusg {

/// The bytes of a regular file.
/// @throws Error naming the file when it is missing, not a regular file, unreadable, or larger than
/// `max_bytes`.
[[nodiscard]] std::string readFile(const std::string& path, std::size_t max_bytes);

/// The first `count` bytes of a regular file, or all of a shorter one.
/// @throws Error naming the file when it is missing, not a regular file or unreadable.
[[nodiscard]] std::string readBeginning(const std::string& path, std::size_t count);

}  // namespace occusg
