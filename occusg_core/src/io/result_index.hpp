// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/file_mark.hpp"

namespace occusg {

/// The file that says which files of a folder one run wrote. It is written after all of them, so a
/// run that was killed while writing leaves the index of the run before it, which some files do not
/// agree with.
inline constexpr const char* kResultIndexFile = "files.json";

/// The text of the index: name, size and checksum of each file.
[[nodiscard]] std::string toResultIndex(const std::map<std::string, FileMark>& files);

/// Files that the index of the folder names, but which are missing or another run's.
/// @return nothing when the folder has no index.
/// @throws Error when the index or a file it names cannot be read.
[[nodiscard]] std::optional<std::vector<std::string>> filesOfOtherRuns(const std::string& folder);

}  // namespace occusg
