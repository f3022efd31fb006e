// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace occusg {

/// What is being written stands beside its place as `.NAME.THREAD.part`, a file or a folder, until
/// it is whole and renamed. The thread's number, unlike that of the process, is no other writing
/// thread's.
[[nodiscard]] std::string partPath(const std::string& folder, const std::string& name);

/// Holds the part that is open at `descriptor` for its writer: no other process takes it for stale,
/// even one in another container, where numbers of threads mean others. Ends when the descriptor is
/// closed. Without effect on a file system that has no locks.
void lockPart(int descriptor);

/// Removes the parts in a folder whose writers were killed: those that no one holds and whose
/// thread is gone. What is not named as a part, and a folder that holds more than files, stays.
/// What cannot be removed is left there.
void removeStaleParts(const std::string& folder);

}  // namespace occusg
