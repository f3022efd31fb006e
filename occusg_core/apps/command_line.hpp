// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "occusg/pipeline/config.hpp"

namespace occusg::apps {

enum ExitCode { kFine = 0, kFailed = 1, kWrongUsage = 2 };

/// The command line was not understood; ends in exit code 2 and a pointer to --help.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One subcommand as its user sees it.
struct CommandHelp {
  std::string synopsis;                  ///< "occusg eval PREDICTED TRUTH [options]".
  std::string description;               ///< What it does, what it reads and writes, examples.
  std::vector<std::string> positionals;  ///< Names of the positional arguments, all required.
  /// Name of a last positional argument that is given once or more; empty for none.
  std::string repeated = {};
};

/// Parsed options; empty when --help was asked for and has been printed.
/// @throws UsageError when an argument is unknown, missing or malformed.
[[nodiscard]] boost::program_options::variables_map parse(
    const std::vector<std::string>& arguments, const CommandHelp& help,
    boost::program_options::options_description options);

[[nodiscard]] inline bool helpWasPrinted(const boost::program_options::variables_map& values) {
  return values.empty();
}

/// Adds --output, required.
void addOutputOption(boost::program_options::options_description& options);
/// Adds --config, whose default is "default", and --param.
void addConfigOption(boost::program_options::options_description& options);
/// Adds --decomposer.
void addDecomposerOption(boost::program_options::options_description& options);

/// The option's value, empty when it was not given.
template <typename T>
[[nodiscard]] std::optional<T> given(const boost::program_options::variables_map& values,
                                     const std::string& name) {
  if (values.count(name) == 0) return std::nullopt;
  return values[name].as<T>();
}

/// The configuration with the parameter `key` set to what `option` was given, if it was.
[[nodiscard]] PipelineConfig overridden(const PipelineConfig& config,
                                        const boost::program_options::variables_map& values,
                                        const std::string& option, const std::string& key);

/// The configuration that --config names, with every --param KEY=VALUE set in it.
/// @throws UsageError for a --param that is not KEY=VALUE; Error as `configFromYaml`.
[[nodiscard]] PipelineConfig givenConfig(const boost::program_options::variables_map& values);

/// The subcommands; arguments without the program's and the command's name.
ExitCode runCommand(const std::vector<std::string>& arguments);
ExitCode segmentCommand(const std::vector<std::string>& arguments);
ExitCode evalCommand(const std::vector<std::string>& arguments);
ExitCode projectCommand(const std::vector<std::string>& arguments);
ExitCode showCommand(const std::vector<std::string>& arguments);
ExitCode sessionCommand(const std::vector<std::string>& arguments);
ExitCode configCommand(const std::vector<std::string>& arguments);
ExitCode batchCommand(const std::vector<std::string>& arguments);
ExitCode ablateCommand(const std::vector<std::string>& arguments);
ExitCode mergeCommand(const std::vector<std::string>& arguments);
ExitCode truthCommand(const std::vector<std::string>& arguments);

}  // namespace occusg::apps
