// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/scene_result.hpp"

namespace occusg {

/// A row a configuration: averages with 95 % intervals.
[[nodiscard]] std::string summaryTables(const BatchResults& batch);
/// The form of the paper's Table 1 at each threshold: a row a scene, configurations side by side.
[[nodiscard]] std::string sceneTables(const BatchResults& batch);
/// Counts of rooms, over- and under-segmentation, a row a scene.
[[nodiscard]] std::string segmentationTable(const BatchResults& batch);
/// Observed-only truth, adjacency, doors, objects: a row a configuration.
[[nodiscard]] std::string companionTables(const BatchResults& batch);
/// The form of the paper's Table 3: a row a stage, mean and standard deviation.
[[nodiscard]] std::string runTimeTable(const BatchResults& batch);
/// Runs that failed, and what was repaired or left out; empty when there is nothing to say.
[[nodiscard]] std::string problemTable(const BatchResults& batch);

}  // namespace occusg
