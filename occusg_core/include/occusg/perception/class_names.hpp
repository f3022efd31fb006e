// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace occusg {

/// Limits of what is read.
inline constexpr std::size_t kMaxClasses = 10'000;
inline constexpr std::size_t kMaxClassNameLength = 200;  ///< [bytes]

/// The names of a model's classes in the order of their ids, one a line, spaces around them
/// dropped. Blank lines may follow the last name but not come before it: they would shift the ids.
/// @param where opens every sentence; the file's path.
/// @throws Error naming the line when one is blank or too long, or when there are no or too many.
[[nodiscard]] std::vector<std::string> parseClassNames(const std::string& text,
                                                       const std::string& where);

/// @throws Error as `parseClassNames`, or when the file cannot be read or exceeds 1 MiB.
[[nodiscard]] std::vector<std::string> readClassNames(const std::string& path);

}  // namespace occusg
