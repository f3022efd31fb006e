// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/config_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxConfigBytes = 65536;
constexpr std::size_t kMaxNesting = 8;

struct WrittenValue {
  std::string key;
  std::string text;
  int line = 0;
};

std::string at(const std::string& where, int line) { return where + ":" + std::to_string(line); }

// The grammar is "key: value" nested by indentation. Everything else YAML offers is refused before
// the parser sees it, which keeps old yaml-cpp's recursion out of reach of the file.
void refuseWhatNoConfigNeeds(const std::string& yaml, const std::string& where) {
  if (yaml.size() > kMaxConfigBytes) {
    throw refuse(where, "the file has " + std::to_string(yaml.size()) + " bytes",
                 "a configuration has at most " + std::to_string(kMaxConfigBytes));
  }
  std::istringstream stream(yaml);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string code = line.substr(0, line.find('#'));
    if (code.find_first_of("[]{}&*!|>?\t") != std::string::npos) {
      throw refuse(at(where, number), "'" + code + "' is not a plain setting",
                   "a configuration is nested lines of 'key: value'");
    }
    const auto first = code.find_first_not_of(' ');
    if (first != std::string::npos && code[first] == '-' && first + 1 < code.size() &&
        code[first + 1] == ' ') {
      throw refuse(at(where, number), "'" + code + "' is a list",
                   "a configuration is nested lines of 'key: value'");
    }
  }
}

void collect(const YAML::Node& node, const std::string& prefix, std::size_t depth,
             const std::string& where, std::vector<WrittenValue>& values) {
  for (const auto& entry : node) {
    const int line = entry.first.Mark().line + 1;
    const std::string key =
        prefix.empty() ? entry.first.Scalar() : prefix + "." + entry.first.Scalar();
    if (entry.second.IsMap()) {
      if (depth == kMaxNesting)
        throw refuse(at(where, line), key + " is nested too deeply", "see 'occusg config --print'");
      collect(entry.second, key, depth + 1, where, values);
    } else {
      values.push_back({key, entry.second.IsScalar() ? entry.second.Scalar() : "", line});
    }
  }
}

std::vector<WrittenValue> valuesIn(const std::string& yaml, const std::string& where) {
  refuseWhatNoConfigNeeds(yaml, where);
  YAML::Node root;
  try {
    root = YAML::Load(yaml);
  } catch (const YAML::Exception& error) {
    throw refuse(at(where, error.mark.line + 1), "this is not YAML (" + error.msg + ")",
                 "see 'occusg config --print' for the form");
  }
  std::vector<WrittenValue> values;
  if (root.IsNull()) return values;
  if (!root.IsMap())
    throw refuse(where, "the document holds no settings", "write lines of 'key: value'");
  collect(root, "", 1, where, values);
  return values;
}

const Parameter& parameterNamed(const std::vector<Parameter>& parameters, const WrittenValue& value,
                                const std::string& where) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& p) { return p.key == value.key; });
  if (found != parameters.end()) return *found;
  std::vector<std::string> keys;
  keys.reserve(parameters.size());
  for (const Parameter& parameter : parameters) keys.push_back(parameter.key);
  const std::string suggestion = suggestionFor(value.key, keys);
  throw refuse(at(where, value.line), "unknown key '" + value.key + "'",
               suggestion.empty() ? "'occusg config --print' lists the keys" : suggestion);
}

std::vector<std::string> split(const std::string& key) {
  std::vector<std::string> parts;
  std::istringstream stream(key);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  return parts;
}

std::string commentOf(const Parameter& parameter) {
  std::string comment = parameter.description;
  if (!parameter.unit.empty()) comment += " [" + parameter.unit + "]";
  comment += " Allowed: " + parameter.allowed + ".";
  if (!parameter.paper.empty()) comment += " Paper: " + parameter.paper + ".";
  return comment;
}

/// Whether reading `path` comes to an end: a file does, and so does what a shell writes as
/// <(command). A named pipe may never get a writer, which would keep the program waiting for ever.
bool isReadToItsEnd(const std::string& path) {
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(path, failed);
  if (std::filesystem::is_regular_file(status)) return true;
  // Only a pipe without a name has no canonical path.
  return std::filesystem::is_fifo(status) && std::filesystem::canonical(path, failed).empty();
}

}  // namespace

std::string toYaml(const PipelineConfig& config, ConfigComments comments) {
  PipelineConfig copy = config;
  std::ostringstream yaml;
  std::vector<std::string> open;
  for (const Parameter& parameter : parametersOf(copy)) {
    const std::vector<std::string> path = split(parameter.key);
    std::size_t shared = 0;
    while (shared < open.size() && shared + 1 < path.size() && open[shared] == path[shared])
      ++shared;
    open.resize(shared);
    for (; open.size() + 1 < path.size(); open.push_back(path[open.size()])) {
      if (open.empty() && yaml.tellp() > 0) yaml << '\n';
      yaml << std::string(2 * open.size(), ' ') << path[open.size()] << ":\n";
    }
    const std::string indent(2 * open.size(), ' ');
    if (comments == ConfigComments::kFull) yaml << indent << "# " << commentOf(parameter) << '\n';
    yaml << indent << path.back() << ": " << parameter.print() << '\n';
  }
  return yaml.str();
}

PipelineConfig configFromYaml(const std::string& yaml, const std::string& where,
                              const PipelineConfig& base) {
  PipelineConfig config = base;
  const std::vector<Parameter> parameters = parametersOf(config);
  std::set<std::string> seen;
  for (const WrittenValue& value : valuesIn(yaml, where)) {
    const Parameter& parameter = parameterNamed(parameters, value, where);
    if (!seen.insert(value.key).second)
      throw refuse(at(where, value.line), value.key + " is set twice", "keep one of the lines");
    if (!parameter.assign(value.text)) {
      throw refuse(
          at(where, value.line), value.key + " is '" + value.text + "'",
          "allowed is " + parameter.allowed + (parameter.unit.empty() ? "" : " " + parameter.unit));
    }
  }
  check(config);
  return config;
}

PipelineConfig loadConfig(const std::string& name_or_path) {
  if (name_or_path == "default") return PipelineConfig{};
  if (name_or_path == "paper") return paperConfig();
  std::error_code failed;
  if (std::filesystem::exists(name_or_path, failed) && !isReadToItsEnd(name_or_path)) {
    throw refuse(name_or_path, "is neither a file nor the output of a command",
                 "a YAML file is needed");
  }
  std::ifstream file(name_or_path, std::ios::binary);
  if (!file) {
    throw refuse(name_or_path, "this configuration cannot be read",
                 "give a YAML file, or one of the names 'default' and 'paper'");
  }
  std::string yaml(kMaxConfigBytes + 1, '\0');
  file.read(yaml.data(), static_cast<std::streamsize>(yaml.size()));
  if (file.bad()) throw refuse(name_or_path, "this configuration cannot be read", "give a file");
  yaml.resize(static_cast<std::size_t>(file.gcount()));
  return configFromYaml(yaml, name_or_path, PipelineConfig{});
}

}  // namespace occusg
