// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/pipeline/config.hpp"

namespace occusg {

/// Whether a written configuration carries the documentation of its parameters.
enum class ConfigComments { kNone, kFull };

/// The configuration as YAML, nested by key, each value with its meaning, unit, range and the
/// paper's value in a comment when asked for.
[[nodiscard]] std::string toYaml(const PipelineConfig& config, ConfigComments comments);

/// Reads a YAML document over `base`: keys that are not named keep their value.
/// @param where name of the document for messages, usually its path.
/// @throws Error naming the line, the key, the value and what is allowed: for an unknown key the
/// nearest known one, for a value out of range the range.
[[nodiscard]] PipelineConfig configFromYaml(const std::string& yaml, const std::string& where,
                                            const PipelineConfig& base);

/// A configuration by the name of a shipped one, "default" or "paper", or else by the path of a
/// YAML file.
/// @throws Error as `configFromYaml`, and when the file cannot be read.
[[nodiscard]] PipelineConfig loadConfig(const std::string& name_or_path);

}  // namespace occusg
