// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "command_line.hpp"
#include "occusg/error.hpp"
#include "occusg/parameter.hpp"
#include "version.hpp"

namespace occusg::apps {
namespace {

using Command = std::function<ExitCode(const std::vector<std::string>&)>;

std::map<std::string, Command> commands() {
  return {{"run", runCommand},         {"segment", segmentCommand}, {"project", projectCommand},
          {"show", showCommand},       {"eval", evalCommand},       {"batch", batchCommand},
          {"ablate", ablateCommand},   {"merge", mergeCommand},     {"truth", truthCommand},
          {"session", sessionCommand}, {"config", configCommand}};
}

constexpr const char* kHelp =
    R"(occusg: rooms and scene graphs from posed depth images, rooms from 2D maps

Usage: occusg COMMAND [arguments]

Commands:
  run SEQUENCE -o OUT       take a recorded RGB-D sequence through the whole pipeline
  segment MAP -o OUT        cut a finished 2D map into rooms
  project MAP -o OUT        make the 2D map of an OctoMap (.bt, .ot)
  show FILE                 print a scene_graph.json, or ask it a question
  eval PREDICTED TRUTH      compare predicted rooms with annotated ones
  batch SEQUENCE... -o OUT  run and compare many recordings, write tables and a report
  ablate SEQUENCE... -o OUT the same over values of one parameter
  merge FOLDER... -o OUT    tables and report of batches run in shards
  truth mp3d HOUSE -o FILE  annotated rooms from a Matterport3D .house file
  session check|repair DIR  tell whether a saved session can be used, make it so
  config --print            write all parameters with units, ranges and the paper's values

Each command explains itself: occusg help COMMAND
Exit codes: 0 fine, 1 the run failed, 2 wrong usage.

Options:
  -h, --help                show this text
  --version                 show the version, the commit and the kind of build
)";

Command commandNamed(const std::string& name) {
  const auto known = commands();
  const auto command = known.find(name);
  if (command != known.end()) return command->second;
  std::vector<std::string> names;
  names.reserve(known.size());
  for (const auto& entry : known) names.push_back(entry.first);
  const bool is_option = name.rfind('-', 0) == 0;
  const std::string suggestion =
      suggestionFor(name, is_option ? std::vector<std::string>{"--help", "--version"} : names);
  throw UsageError((is_option ? "unknown option '" : "unknown command '") + name + "'" +
                   (suggestion.empty() ? std::string() : "; " + suggestion));
}

/// @throws UsageError when more arguments are given than are looked at.
void requireAtMost(std::size_t count, const std::vector<std::string>& arguments,
                   const std::string& name) {
  if (arguments.size() > count)
    throw UsageError("'" + arguments[count] + "' is one argument too many for '" + name + "'");
}

ExitCode dispatch(std::vector<std::string> arguments) {
  if (arguments.empty()) throw UsageError("no command given");
  const std::string name = arguments.front();
  arguments.erase(arguments.begin());
  if (name == "--version") {
    requireAtMost(0, arguments, name);
    std::cout << versionText() << '\n';
    return kFine;
  }
  if (name == "help" && !arguments.empty()) {
    requireAtMost(1, arguments, name);
    return commandNamed(arguments.front())({"--help"});
  }
  if (name == "--help" || name == "-h" || name == "help") {
    requireAtMost(0, arguments, name);
    std::cout << kHelp;
    return kFine;
  }
  return commandNamed(name)(arguments);
}

/// The page of help that the arguments need: that of their command, where they name one.
std::string helpFor(const std::vector<std::string>& arguments) {
  const bool has_command = !arguments.empty() && commands().count(arguments.front()) > 0;
  return has_command ? "occusg help " + arguments.front() : "occusg --help";
}

/// What was printed may still be on its way: a full disk shows only now.
/// @throws Error when it cannot be printed.
void flushOutput() {
  const bool was_good = std::cout.good();
  errno = 0;
  std::cout.flush();
  if (std::cout.good()) return;
  const std::string why =
      was_good && errno != 0 ? " (" + std::generic_category().message(errno) + ")" : "";
  throw refuse("standard output", "cannot be written" + why,
               "a place with space left is needed; files of results are not affected");
}

int guarded(const std::vector<std::string>& arguments) {
  try {
    const ExitCode code = dispatch(arguments);
    flushOutput();
    return code;
  } catch (const UsageError& error) {
    std::cerr << "occusg: " << error.what() << " (see '" << helpFor(arguments) << "')\n";
    return kWrongUsage;
  } catch (const Error& error) {
    std::cerr << "occusg: " << error.what() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "occusg: unexpected failure: " << error.what() << '\n';
  }
  return kFailed;
}

}  // namespace
}  // namespace occusg::apps

int main(int argc, char** argv) {
  return occusg::apps::guarded(std::vector<std::string>(argv + 1, argv + argc));
}
