// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"
#include "report/scene_result.hpp"

namespace occusg::apps {

/// `batch.json`, what a batch is made of: {"format": "occusg-batch", "version", "configurations",
/// "scenes", "alignment", "title"}.
struct BatchIndex {
  std::vector<std::string> configurations;
  std::vector<std::string> scenes;
  std::string alignment;
  std::string title;
};

[[nodiscard]] std::string toJson(const BatchIndex& index);
/// @throws Error naming the value that cannot be used, or when the folder holds no batch.
[[nodiscard]] BatchIndex readBatchIndex(const std::string& folder);

[[nodiscard]] std::string sceneFolder(const std::string& out, const std::string& configuration,
                                      const std::string& scene);

/// Evaluates every scene of the batches in `folders`, the first that holds a scene's run giving it.
/// @throws Error when the batches differ in their alignment.
[[nodiscard]] BatchResults collectResults(const std::vector<std::string>& folders);

/// Writes results.csv, results.json and report.html, and prints the averages.
void writeResults(const BatchResults& batch, const std::string& title, const std::string& out);

/// Says on standard error which runs failed.
/// @return kFailed when any did.
[[nodiscard]] ExitCode reportFailures(const BatchResults& batch);

}  // namespace occusg::apps
