// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/scene_result.hpp"

namespace occusg {

/// `results.csv` (RFC 4180): a line a scene and configuration with status, problem, seconds and
/// every metric; what is undefined is empty.
[[nodiscard]] std::string toCsv(const BatchResults& batch);

/// `results.json`: {"format": "occusg-batch-results", "version", "alignment", "configurations":
/// [{"name", "scenes", "failed", "missing", "macro", "micro"}], "scenes": [{"configuration",
/// "scene", "status", "problem", "seconds", "notes", "metrics", "observed", "adjacency", "doors",
/// "objects", "timing"}]}. An average is {"value", "low", "high"}, the ends of its 95 % interval.
[[nodiscard]] std::string toJson(const BatchResults& batch);

}  // namespace occusg
