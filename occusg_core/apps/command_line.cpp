// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.hpp"

#include <iostream>

#include "occusg/pipeline/config_file.hpp"

namespace occusg::apps {
namespace po = boost::program_options;

po::variables_map parse(const std::vector<std::string>& arguments, const CommandHelp& help,
                        po::options_description options) {
  options.add_options()("help,h", "show this text");
  po::options_description all;
  all.add(options);
  po::positional_options_description positionals;
  for (const std::string& name : help.positionals) {
    all.add_options()(name.c_str(), po::value<std::string>());
    positionals.add(name.c_str(), 1);
  }
  if (!help.repeated.empty()) {
    all.add_options()(help.repeated.c_str(), po::value<std::vector<std::string>>());
    positionals.add(help.repeated.c_str(), -1);
  }

  po::variables_map values;
  try {
    namespace style = po::command_line_style;
    po::store(po::command_line_parser(arguments)
                  .options(all)
                  .positional(positionals)
                  .style(style::unix_style & ~style::allow_guessing)
                  .run(),
              values);
    if (values.count("help") > 0) {
      std::cout << "Usage: " << help.synopsis << "\n\n" << help.description << "\n" << options;
      return {};
    }
    po::notify(values);
  } catch (const po::too_many_positional_options_error&) {
    throw UsageError("too many arguments: the form is '" + help.synopsis + "'");
  } catch (const po::error& error) {
    throw UsageError(error.what());
  }
  std::vector<std::string> required = help.positionals;
  if (!help.repeated.empty()) required.push_back(help.repeated);
  for (const std::string& name : required) {
    if (values.count(name) == 0)
      throw UsageError(name + " is missing: the form is '" + help.synopsis + "'");
  }
  return values;
}

void addOutputOption(po::options_description& options) {
  options.add_options()("output,o", po::value<std::string>()->required(),
                        "folder for the results; created when missing");
}

void addConfigOption(po::options_description& options) {
  options.add_options()("config", po::value<std::string>()->default_value("default"),
                        "'default', 'paper' or a YAML file (see 'occusg config --print')");
}

void addDecomposerOption(po::options_description& options) {
  options.add_options()("decomposer", po::value<std::string>(), "overrides regions.decomposer");
}

PipelineConfig overridden(const PipelineConfig& config, const po::variables_map& values,
                          const std::string& option, const std::string& key) {
  const auto text = given<std::string>(values, option);
  if (!text) return config;
  return configFromYaml(key + ": " + *text + "\n", "--" + option, config);
}

}  // namespace occusg::apps
