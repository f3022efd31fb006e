// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_lines.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "io/file_bytes.hpp"
#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr std::size_t kMaxListBytes = std::size_t{256} << 20U;
constexpr const char* kSeparators = " \t\r\v\f";

/// Behind the byte order mark that some editors put before UTF-8.
std::size_t beginOfText(const std::string& bytes) {
  constexpr const char* kMark = "\xEF\xBB\xBF";
  return bytes.rfind(kMark, 0) == 0 ? 3 : 0;
}

bool isBlankOrComment(const std::string& line) {
  const std::size_t first = line.find_first_not_of(kSeparators);
  return first == std::string::npos || line[first] == '#';
}

}  // namespace

std::vector<TextLine> readLines(const std::string& path) {
  const std::string bytes = readFile(path, kMaxListBytes);
  std::vector<TextLine> lines;
  std::size_t number = 0;
  for (std::size_t start = beginOfText(bytes); start < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', start), bytes.size());
    if (++number > kMaxLines) {
      throw refuse(path, "has more than " + std::to_string(kMaxLines) + " lines",
                   "a shorter list is needed");
    }
    std::string text = bytes.substr(start, std::min(end - start, kMaxLineLength + 1));
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (!isBlankOrComment(text)) lines.push_back({number, std::move(text)});
    start = end + 1;
  }
  return lines;
}

std::string placeOf(const std::string& path, const TextLine& line) {
  return path + ":" + std::to_string(line.number);
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::size_t start = text.find_first_not_of(kSeparators);
  while (start != std::string::npos) {
    const std::size_t end = text.find_first_of(kSeparators, start);
    words.push_back(text.substr(start, end - start));
    start = text.find_first_not_of(kSeparators, end);
  }
  return words;
}

std::optional<double> numberIn(const std::string& word) {
  // Not strtod: it obeys the locale of the program, where 1.5 may be spelt 1,5.
  std::istringstream stream(word);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  stream >> value;
  const bool whole = !stream.fail() && stream.peek() == std::istringstream::traits_type::eof();
  if (!whole || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }

std::string shown(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  std::string result = text.substr(0, kLongest);
  std::replace_if(result.begin(), result.end(), isControl, '?');
  return text.size() > kLongest ? result + "..." : result;
}

}  // namespace occusg
