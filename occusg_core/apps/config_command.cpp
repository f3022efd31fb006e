// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "command_line.hpp"
#include "occusg/pipeline/config_file.hpp"

namespace occusg::apps {

ExitCode configCommand(const std::vector<std::string>& arguments) {
  namespace po = boost::program_options;
  const CommandHelp help{
      "occusg config --print [--config NAME_OR_FILE] [--param KEY=VALUE]",
      "Writes every parameter as YAML with its meaning, unit, allowed values and the published\n"
      "system's value. Edit a copy and give it to 'occusg run --config FILE'; lines that keep the\n"
      "default may be left out.\n\n"
      "  occusg config --print > mine.yaml\n"
      "  occusg config --print --config paper\n",
      {}};
  po::options_description options("Options");
  options.add_options()("print", "write the parameters to standard output");
  addConfigOption(options);
  const po::variables_map values = parse(arguments, help, options);
  if (helpWasPrinted(values)) return kFine;
  if (values.count("print") == 0)
    throw UsageError("--print is missing; the form is '" + help.synopsis + "'");
  std::cout << toYaml(givenConfig(values), ConfigComments::kFull);
  return kFine;
}

}  // namespace occusg::apps
