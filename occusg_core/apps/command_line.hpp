// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>
#include <stdexcept>
#include <string>
#include <vector>

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

/// The subcommands; arguments without the program's and the command's name.
ExitCode runCommand(const std::vector<std::string>& arguments);
ExitCode segmentCommand(const std::vector<std::string>& arguments);
ExitCode evalCommand(const std::vector<std::string>& arguments);
ExitCode configCommand(const std::vector<std::string>& arguments);
ExitCode batchCommand(const std::vector<std::string>& arguments);
ExitCode ablateCommand(const std::vector<std::string>& arguments);
ExitCode mergeCommand(const std::vector<std::string>& arguments);
ExitCode truthCommand(const std::vector<std::string>& arguments);

}  // namespace occusg::apps
