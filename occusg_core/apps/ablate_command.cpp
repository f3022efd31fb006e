// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "batch_options.hpp"
#include "batch_runner.hpp"
#include "command_line.hpp"
#include "occusg/pipeline/config_file.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

constexpr const char* kDepthThreshold = "regions.dude.depth_threshold_m";
constexpr const char* kDudeParameters = "regions.dude.";

CommandHelp ablateHelp() {
  return {
      "occusg ablate SEQUENCE... -o OUT (--d-thr VALUES | --param KEY=VALUES) [options]",
      "Runs the recordings once for each value of one parameter and writes what 'occusg batch'\n"
      "writes, a row a value: the paper's Table 2. A parameter of the decomposer dude is varied\n"
      "with dude as the decomposer.\n\n"
      "  occusg ablate recordings/* -o out --d-thr 1.5,3,6\n"
      "  occusg ablate recordings/* -o out --param regions.constriction.widest_door_m=1.5,2.5\n",
      {},
      "SEQUENCE"};
}

po::options_description ablateOptions() {
  po::options_description options = batchOptionsDescription();
  options.add_options()("param", po::value<std::string>(), "KEY=VALUE,VALUE,...: what is varied")(
      "d-thr", po::value<std::string>(),
      "VALUE,VALUE,...: short for --param regions.dude.depth_threshold_m=...")(
      "config", po::value<std::string>()->default_value("default"),
      "all other parameters: 'default', 'paper' or a YAML file");
  return options;
}

/// A parameter and the texts of its values.
struct Variation {
  std::string key;
  std::vector<std::string> values;
};

Variation variationFrom(const po::variables_map& given) {
  if (given.count("param") + given.count("d-thr") != 1)
    throw UsageError("occusg ablate needs either --param KEY=VALUES or --d-thr VALUES");
  Variation variation{kDepthThreshold, {}};
  std::string list;
  if (given.count("d-thr") > 0) {
    list = given["d-thr"].as<std::string>();
  } else {
    const std::string text = given["param"].as<std::string>();
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--param is '" + text + "'; allowed is KEY=VALUE,VALUE,...");
    variation.key = text.substr(0, equals);
    list = text.substr(equals + 1);
  }
  if (list.empty()) throw UsageError("no value is given for " + variation.key);
  std::istringstream values(list + ",");  // what follows the last comma is a value too
  for (std::string value; std::getline(values, value, ',');) {
    if (value.empty())
      throw UsageError("the values of " + variation.key + " are '" + list + "'; one is empty");
    variation.values.push_back(value);
  }
  return variation;
}

std::vector<Configuration> configurationsFrom(const po::variables_map& values) {
  const Variation variation = variationFrom(values);
  PipelineConfig base = loadConfig(values["config"].as<std::string>());
  if (variation.key.rfind(kDudeParameters, 0) == 0)
    base = configFromYaml("regions.decomposer: dude\n", "occusg ablate", base);
  const std::string name = variation.key.substr(variation.key.rfind('.') + 1);
  std::vector<Configuration> configurations;
  for (const std::string& value : variation.values) {
    std::string yaml = variation.key;
    yaml.append(": ").append(value).append("\n");
    const PipelineConfig config = configFromYaml(yaml, "--param " + variation.key, base);
    std::string row = name;
    row.append("=").append(value);
    configurations.push_back({std::move(row), toYaml(config, ConfigComments::kNone), ""});
  }
  requireDistinctNames(configurations);
  return configurations;
}

}  // namespace

ExitCode ablateCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, ablateHelp(), ablateOptions());
  if (helpWasPrinted(values)) return kFine;
  BatchOptions options = batchOptionsFrom(values);
  options.configurations = configurationsFrom(values);
  return runAndReport(options);
}

}  // namespace occusg::apps
