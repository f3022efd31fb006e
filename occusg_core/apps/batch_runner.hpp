// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "batch_options.hpp"
#include "command_line.hpp"

namespace occusg::apps {

/// Whether all was run.
enum class BatchEnd { kComplete, kInterrupted };

/// Brings every scene of the shard under every configuration into its folder,
/// OUT/<configuration>/<scene>: a process each for our own runs, at most `jobs` at a time, so that
/// a crash costs one row; copies of external predictions. What is finished with the same parameters
/// and recording is kept. Writes OUT/batch.json first. Prints a line a scene with the time left.
/// @throws Error when the output cannot be written.
[[nodiscard]] BatchEnd runBatch(const BatchOptions& options);

/// Runs the batch and writes its results; of a shard, only the runs, for `occusg merge`.
/// @return kFailed when it was interrupted or a run failed.
[[nodiscard]] ExitCode runAndReport(const BatchOptions& options);

}  // namespace occusg::apps
