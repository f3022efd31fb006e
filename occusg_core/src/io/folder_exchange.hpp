// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace occusg {

/// Where a folder waits while another takes its place: `.NAME.before` beside it.
[[nodiscard]] std::filesystem::path placeOfTheSetAside(const std::filesystem::path& place);

/// Puts the folder `fresh` where `place` is, which may be missing or empty, and flushes the folder
/// around them. In one step where the file system can exchange two names; elsewhere (NFS, some
/// FUSE) the old one is set aside first, so that a process that ends between two steps leaves
/// either of them whole: at `place`, or set aside with `place` missing. The old one is then at
/// `fresh`, or gone.
/// @throws Error naming `place` when it cannot be replaced; it is untouched then.
void putInPlace(const std::filesystem::path& fresh, const std::filesystem::path& place);

/// `place`, or, when that is missing, what was set aside for a folder that never came.
[[nodiscard]] std::filesystem::path standingFolder(const std::filesystem::path& place);

}  // namespace occusg
