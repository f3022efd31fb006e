// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>

#include "batch_options.hpp"
#include "batch_results.hpp"
#include "batch_runner.hpp"
#include "command_line.hpp"
#include "occusg/error.hpp"
#include "occusg/pipeline/config_file.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;
using Texts = std::vector<std::string>;

CommandHelp batchHelp() {
  return {
      "occusg batch SEQUENCE... -o OUT [options]",
      "Runs many recordings under one or more configurations, compares the rooms with the\n"
      "annotated ones (rooms.json of the recording) and writes results.csv, results.json and\n"
      "report.html. Each run is a process of its own: one that crashes or takes too long is a\n"
      "row with its error. Started again, only what is not finished is run.\n\n"
      "  occusg batch recordings/* -o out --jobs 4\n"
      "  occusg batch recordings/* -o out --config default --config paper --decomposer dude \\\n"
      "      --external hydra=predictions/hydra\n"
      "  occusg batch recordings/* -o out --shard 2/8    # on each of eight machines\n",
      {},
      "SEQUENCE"};
}

po::options_description batchOptions() {
  po::options_description options = batchOptionsDescription();
  options.add_options()("config", po::value<Texts>()->composing(),
                        "a row: 'default', 'paper' or a YAML file; may be given again")(
      "decomposer", po::value<Texts>()->composing(),
      "a row: the first --config with this decomposer; may be given again")(
      "external", po::value<Texts>()->composing(),
      "NAME=FOLDER, a row: rooms others predicted, FOLDER/<scene>.json or "
      "FOLDER/<scene>/rooms.json");
  return options;
}

Texts textsOf(const po::variables_map& values, const std::string& name) {
  return values.count(name) == 0 ? Texts{} : values[name].as<Texts>();
}

Configuration externalFrom(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--external is '" + text + "'; allowed is NAME=FOLDER");
  const std::string folder = text.substr(equals + 1);
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw refuse("--external " + text, "'" + folder + "' is no folder", "a folder is needed");
  return {text.substr(0, equals), "", std::filesystem::absolute(folder).string()};
}

std::vector<Configuration> configurationsFrom(const po::variables_map& values) {
  const Texts externals = textsOf(values, "external");
  const Texts decomposers = textsOf(values, "decomposer");
  Texts configs = textsOf(values, "config");
  const std::string base = configs.empty() ? "default" : configs.front();
  if (configs.empty() && decomposers.empty() && externals.empty()) configs = {"default"};
  std::vector<Configuration> configurations;
  for (const std::string& config : configs) {
    configurations.push_back({std::filesystem::path(config).stem().string(),
                              toYaml(loadConfig(config), ConfigComments::kNone), ""});
  }
  for (const std::string& decomposer : decomposers) {
    const PipelineConfig config = configFromYaml("regions.decomposer: " + decomposer + "\n",
                                                 "--decomposer", loadConfig(base));
    configurations.push_back({decomposer, toYaml(config, ConfigComments::kNone), ""});
  }
  for (const std::string& external : externals) configurations.push_back(externalFrom(external));
  requireDistinctNames(configurations);
  return configurations;
}

}  // namespace

ExitCode batchCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, batchHelp(), batchOptions());
  if (helpWasPrinted(values)) return kFine;
  BatchOptions options = batchOptionsFrom(values);
  options.configurations = configurationsFrom(values);
  return runAndReport(options);
}

}  // namespace occusg::apps
