// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "occusg/evaluation/alignment.hpp"

namespace occusg::apps {

/// A recording and what its scene is called: the name of its folder.
struct Recording {
  std::string scene;
  std::string folder;  ///< Absolute path.
};

/// A way to get rooms of a recording: our pipeline with some parameters, or files of others.
struct Configuration {
  std::string name;             ///< Also of its folder in the output.
  std::string yaml;             ///< All parameters; empty for external predictions.
  std::string external_folder;  ///< Holds <scene>.json or <scene>/rooms.json; empty for ours.
};

/// Which part of the work to do: scenes number `index`, `index + count`, ... from 0.
struct Shard {
  std::size_t index = 0;
  std::size_t count = 1;
};

struct BatchOptions {
  std::vector<Recording> recordings;
  std::vector<Configuration> configurations;
  std::string out;
  std::string title;
  std::size_t jobs = 1;
  double timeout_s = 0.0;  ///< A run that takes longer is ended; 0: never.
  Alignment alignment = Alignment::kNone;
  Shard shard;
};

/// What `batch` and `ablate` share.
[[nodiscard]] boost::program_options::options_description batchOptionsDescription();
/// All but the configurations.
/// @throws UsageError for values out of range; Error for scenes of one name.
[[nodiscard]] BatchOptions batchOptionsFrom(const boost::program_options::variables_map& values);

/// @throws UsageError unless none, centroid or search.
[[nodiscard]] Alignment alignmentNamed(const std::string& name);
[[nodiscard]] std::string nameOf(Alignment alignment);

/// @throws Error when two have one name.
void requireDistinctNames(const std::vector<Configuration>& configurations);

}  // namespace occusg::apps
