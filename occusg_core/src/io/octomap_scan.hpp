// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "occusg/io/octomap_file.hpp"

namespace occusg {

/// The text a map file begins with.
/// @param bytes the file, or at least its beginning.
/// @throws Error naming `where` and the line at fault.
[[nodiscard]] OctomapHeader scanOctomapHeader(const std::string& bytes, const std::string& where);

/// Checks that what follows the text is one whole tree, at most 16 levels deep, and nothing else.
/// OctoMap's readers check none of this.
/// @throws Error naming `where` and the byte at fault.
/// @param max_memory_mb what the map may take when it is built [MiB]: a pruned node of a few bytes
/// may stand for a building full of voxels.
[[nodiscard]] std::size_t checkOctomapData(const std::string& bytes, const OctomapHeader& header,
                                           const std::string& where, double max_memory_mb);

/// Bytes of a node of that type in a `.ot`: log-odds, colour if any, children.
[[nodiscard]] std::size_t octomapNodeBytes(const OctomapHeader& header);

}  // namespace occusg
