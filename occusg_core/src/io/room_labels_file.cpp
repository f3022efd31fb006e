// SPDX-License-Identifier: BSD-3-Clause
#include "io/room_labels_file.hpp"

#include <cstddef>
#include <locale>
#include <optional>
#include <sstream>

#include "graph/class_key.hpp"
#include "graph/room_labels.hpp"
#include "io/file_bytes.hpp"
#include "occusg/error.hpp"
#include "occusg/parameter.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;
constexpr std::size_t kMaxEntries = 1000;
constexpr double kMaxWeight = 100.0;

struct Line {
  bool is_indented = false;
  std::string name;
  std::string value;  ///< Empty: nothing follows the colon.
};

std::string trimmed(const std::string& text) {
  constexpr const char* kSpace = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

/// Empty when the line says nothing.
std::optional<Line> parsed(const std::string& text, const std::string& where) {
  const std::string code = text.substr(0, text.find('#'));
  if (trimmed(code).empty()) return std::nullopt;
  const std::size_t colon = code.find(':');
  const std::string name = colon == std::string::npos ? "" : trimmed(code.substr(0, colon));
  if (name.empty() || name.size() > kMaxLabelLength) {
    throw refuse(where, "'" + trimmed(code).substr(0, 80) + "' is no entry",
                 "\"label:\", or indented \"class: weight\", is needed");
  }
  return Line{code[0] == ' ', name, trimmed(code.substr(colon + 1))};
}

double weightIn(const std::string& text, const std::string& where) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double weight = 0.0;
  const bool is_number =
      (stream >> weight) && stream.peek() == std::istringstream::traits_type::eof();
  if (!is_number || !(weight > 0.0 && weight <= kMaxWeight))
    throw refuse(where, "the weight is '" + text.substr(0, 80) + "'", "(0, 100] is allowed");
  return weight;
}

}  // namespace

std::string toYaml(const RoomLabelTable& table) {
  std::string yaml =
      "# What speaks for a kind of room: the weight of each object class in it. A class counts "
      "twice\n"
      "# at most; the label with the greatest sum wins if it leads clearly.\n";
  for (const auto& [label, weights] : table) {
    yaml += "\n" + label + ":\n";
    for (const auto& [name, weight] : weights)
      yaml += "  " + name + ": " + shortestText(weight) + "\n";
  }
  return yaml;
}

RoomLabelTable roomLabelsFromYaml(const std::string& yaml, const std::string& where) {
  RoomLabelTable table;
  std::map<std::string, double>* weights = nullptr;
  std::istringstream stream(yaml);
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    const std::string at = where + ":" + std::to_string(number);
    const std::optional<Line> line = parsed(text, at);
    if (!line) continue;
    if (!line->is_indented) {
      if (!line->value.empty()) {
        throw refuse(at, "a value follows the label '" + line->name + "'",
                     "its classes are needed");
      }
      const auto [item, is_new] = table.try_emplace(line->name);
      if (!is_new) throw refuse(at, "label '" + line->name + "' is there twice", "keep one");
      if (table.size() > kMaxEntries) throw refuse(at, "there are over 1000 labels", "keep fewer");
      weights = &item->second;
      continue;
    }
    if (weights == nullptr) {
      throw refuse(at, "class '" + line->name + "' comes before any label",
                   "begin with \"label:\"");
    }
    const double weight = weightIn(line->value, at);
    if (!weights->emplace(classKey(line->name), weight).second)
      throw refuse(at, "class '" + line->name + "' is there twice", "keep one");
    if (weights->size() > kMaxEntries)
      throw refuse(at, "there are over 1000 classes", "keep fewer");
  }
  return table;
}

RoomLabelTable readRoomLabels(const std::string& path) {
  return roomLabelsFromYaml(readFile(path, kMaxBytes), path);
}

}  // namespace occusg
