// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/perception/class_names.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;

std::string trimmed(const std::string& text) {
  constexpr const char* kSpaces = " \t\r\v\f";
  const std::size_t first = text.find_first_not_of(kSpaces);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    lines.push_back(trimmed(text.substr(start, end - start)));
    start = end + 1;
  }
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

}  // namespace

std::vector<std::string> parseClassNames(const std::string& text, const std::string& where) {
  std::vector<std::string> names = linesOf(text);
  if (names.empty()) throw refuse(where, "holds no class name", "one name a line is needed");
  if (names.size() > kMaxClasses) {
    throw refuse(where, "has " + std::to_string(names.size()) + " class names",
                 "at most " + std::to_string(kMaxClasses) + " are read");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string line = where + ":" + std::to_string(i + 1);
    if (names[i].empty()) throw refuse(line, "is blank", "each line before the last needs a name");
    if (names[i].size() > kMaxClassNameLength) {
      throw refuse(line, "is " + std::to_string(names[i].size()) + " bytes long",
                   "a class name has at most " + std::to_string(kMaxClassNameLength));
    }
  }
  return names;
}

std::vector<std::string> readClassNames(const std::string& path) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed))
    throw refuse(path, "is not a file", "a list of class names, one a line, is needed");
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  if (failed || size > kMaxBytes) {
    throw refuse(path, "is longer than " + std::to_string(kMaxBytes) + " bytes",
                 "a list of class names, one a line, is needed");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw refuse(path, "cannot be opened", "a readable file is needed");
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return parseClassNames(text, path);
}

}  // namespace occusg
