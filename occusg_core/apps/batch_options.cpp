// SPDX-License-Identifier: BSD-3-Clause
#include "batch_options.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "command_line.hpp"
#include "occusg/error.hpp"

namespace occusg::apps {
namespace {

namespace po = boost::program_options;
namespace fs = std::filesystem;

constexpr std::size_t kMaxJobs = 256;
constexpr std::size_t kMaxShards = 100'000;

const std::map<std::string, Alignment>& alignments() {
  static const std::map<std::string, Alignment> kAlignments{{"none", Alignment::kNone},
                                                            {"centroid", Alignment::kCentroid},
                                                            {"search", Alignment::kSearch}};
  return kAlignments;
}

Recording recordingAt(const std::string& path) {
  std::error_code ignored;
  fs::path folder = fs::weakly_canonical(fs::absolute(path), ignored);
  if (folder.filename().empty()) folder = folder.parent_path();
  return {folder.filename().string(), folder.string()};
}

std::vector<Recording> recordingsAt(const std::vector<std::string>& paths) {
  std::vector<Recording> recordings;
  std::map<std::string, std::string> folder_of;
  for (const std::string& path : paths) {
    recordings.push_back(recordingAt(path));
    const Recording& recording = recordings.back();
    if (recording.scene.empty())
      throw refuse(path, "has no name", "the folder of a recording is needed");
    const auto [known, is_new] = folder_of.emplace(recording.scene, recording.folder);
    if (!is_new) {
      throw refuse(recording.folder, "is called as " + known->second,
                   "folders of different names are needed");
    }
  }
  return recordings;
}

Shard shardIn(const std::string& text) {
  std::istringstream stream(text);
  long number = 0, count = 0;
  char slash = ' ';
  const bool is_read = static_cast<bool>(stream >> number >> slash >> count) && slash == '/' &&
                       stream.peek() == std::istringstream::traits_type::eof();
  if (!is_read || number < 1 || count < number || count > static_cast<long>(kMaxShards))
    throw UsageError("--shard is '" + text + "'; allowed is K/N with 1 <= K <= N");
  return {static_cast<std::size_t>(number - 1), static_cast<std::size_t>(count)};
}

}  // namespace

po::options_description batchOptionsDescription() {
  po::options_description options("Options");
  options.add_options()("output,o", po::value<std::string>()->required(),
                        "folder for the results; finished scenes in it are not run again")(
      "jobs,j", po::value<int>()->default_value(1), "how many recordings run at a time")(
      "timeout", po::value<double>()->default_value(0.0),
      "seconds after which a run is ended and counts as failed; 0: never")(
      "align", po::value<std::string>()->default_value("none"),
      "how the truth is moved onto the prediction: none, centroid or search")(
      "shard", po::value<std::string>(),
      "K/N: only every N-th scene from the K-th on; 'occusg merge' joins the shards")(
      "title", po::value<std::string>()->default_value("Rooms in recordings"),
      "heading of the report");
  return options;
}

BatchOptions batchOptionsFrom(const po::variables_map& values) {
  BatchOptions options;
  options.recordings = recordingsAt(values["SEQUENCE"].as<std::vector<std::string>>());
  options.out = values["output"].as<std::string>();
  options.title = values["title"].as<std::string>();
  options.alignment = alignmentNamed(values["align"].as<std::string>());
  const int jobs = values["jobs"].as<int>();
  if (jobs < 1 || jobs > static_cast<int>(kMaxJobs))
    throw UsageError("--jobs is " + std::to_string(jobs) + "; allowed is 1 to 256");
  options.jobs = static_cast<std::size_t>(jobs);
  options.timeout_s = values["timeout"].as<double>();
  if (!(options.timeout_s >= 0.0)) throw UsageError("--timeout must be 0 or more seconds");
  if (values.count("shard") > 0) options.shard = shardIn(values["shard"].as<std::string>());
  return options;
}

Alignment alignmentNamed(const std::string& name) {
  const auto found = alignments().find(name);
  if (found == alignments().end())
    throw UsageError("--align is '" + name + "'; allowed is none, centroid or search");
  return found->second;
}

std::string nameOf(Alignment alignment) {
  for (const auto& [name, value] : alignments())
    if (value == alignment) return name;
  return "";
}

void requireDistinctNames(const std::vector<Configuration>& configurations) {
  std::set<std::string> names;
  for (const Configuration& configuration : configurations) {
    const std::string& name = configuration.name;
    if (name.empty() || name.find('/') != std::string::npos || name.front() == '.') {
      throw refuse("configuration '" + name + "'", "cannot be the name of a folder",
                   "another name is needed");
    }
    if (!names.insert(name).second)
      throw refuse("configuration '" + name + "'", "is given twice", "different names are needed");
  }
}

}  // namespace occusg::apps
