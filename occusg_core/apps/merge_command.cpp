// SPDX-License-Identifier: BSD-3-Clause
#include "batch_results.hpp"
#include "command_line.hpp"
#include "occusg/io/results.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;

CommandHelp mergeHelp() {
  return {
      "occusg merge FOLDER... -o OUT [options]",
      "Writes results.csv, results.json and report.html of batches that were run in shards, on\n"
      "one disk or several. FOLDER is the output of 'occusg batch'; a scene that is in several\n"
      "is taken from the first. Scenes no shard has run are rows that say so.\n\n"
      "  occusg merge out -o out\n"
      "  occusg merge node1/out node2/out -o all\n",
      {},
      "FOLDER"};
}

po::options_description mergeOptions() {
  po::options_description options("Options");
  options.add_options()("output,o", po::value<std::string>()->required(),
                        "folder for tables and report; created when missing")(
      "title", po::value<std::string>(), "heading of the report");
  return options;
}

}  // namespace

ExitCode mergeCommand(const std::vector<std::string>& arguments) {
  const po::variables_map values = parse(arguments, mergeHelp(), mergeOptions());
  if (helpWasPrinted(values)) return kFine;
  checkResultsPlace(values["output"].as<std::string>());
  const auto folders = values["FOLDER"].as<std::vector<std::string>>();
  const BatchResults batch = collectResults(folders);
  const std::string title = values.count("title") > 0 ? values["title"].as<std::string>()
                                                      : readBatchIndex(folders.front()).title;
  writeResults(batch, title, values["output"].as<std::string>());
  return reportFailures(batch);
}

}  // namespace occusg::apps
