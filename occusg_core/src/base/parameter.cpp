// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/parameter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <numeric>
#include <optional>
#include <sstream>

#include "occusg/error.hpp"

namespace occusg {
namespace {

constexpr std::size_t kLettersPerTypo = 3;

// Streams with the classic locale: a German desktop must not turn 0.05 into 0.
template <typename T>
std::optional<T> parsed(std::string_view text) {
  std::istringstream stream{std::string(text)};
  stream.imbue(std::locale::classic());
  T value{};
  if (!(stream >> value) || stream.peek() != std::istringstream::traits_type::eof()) return {};
  return value;
}

std::optional<double> parsedNumber(std::string_view text) {
  if (text == ".inf" || text == "+.inf") return std::numeric_limits<double>::infinity();
  if (text == "-.inf") return -std::numeric_limits<double>::infinity();
  return parsed<double>(text);
}

std::string rangeText(const std::string& min, const std::string& max) {
  return "[" + min + ", " + max + "]";
}

/// Written so that NaN, which compares false with everything, is not in it.
template <typename T>
bool contains(const Range<T>& range, T value) {
  return value >= range.min && value <= range.max;
}

template <typename T>
Parameter rangedParameter(T& value, Range<T> range, ParameterText text) {
  Parameter parameter{std::move(text.key),
                      std::move(text.unit),
                      rangeText(shortestText(range.min), shortestText(range.max)),
                      std::move(text.description),
                      std::move(text.paper),
                      {},
                      {},
                      {}};
  parameter.print = [&value] { return shortestText(value); };
  parameter.assign = [&value, range](std::string_view written) {
    std::optional<T> number;
    if constexpr (std::is_same_v<T, double>) {
      number = parsedNumber(written);
    } else {
      number = parsed<T>(written);
    }
    if (!number || !contains(range, *number)) return false;
    value = *number;
    return true;
  };
  parameter.holds = [&value, range] { return contains(range, value); };
  return parameter;
}

/// From `name` to `known`, or to what follows a dot in it if that is nearer.
std::size_t editsToEndOf(const std::string& known, const std::string& name) {
  std::size_t fewest = editDistance(name, known);
  for (std::size_t dot = known.find('.'); dot != std::string::npos; dot = known.find('.', dot + 1))
    fewest = std::min(fewest, editDistance(name, known.substr(dot + 1)));
  return fewest;
}

}  // namespace

void check(const std::vector<Parameter>& parameters) {
  for (const Parameter& parameter : parameters) {
    if (parameter.holds()) continue;
    const std::string value = parameter.print();
    throw refuse(parameter.key, "is " + (value.empty() ? "not one of the choices" : value),
                 "allowed is " + parameter.allowed);
  }
}

std::string shortestText(double value) {
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  if (value == 0.0) return "0";
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(digits);
    stream << value;
    const bool needs_exponent = std::abs(value) >= 1e6 || std::abs(value) < 1e-4;
    if (!needs_exponent && stream.str().find('e') != std::string::npos) continue;
    if (parsed<double>(stream.str()) == value) return stream.str();
  }
  return ".nan";
}

Parameter numberParameter(double& value, Range<double> range, ParameterText text) {
  return rangedParameter(value, range, std::move(text));
}

Parameter countParameter(int& value, Range<int> range, ParameterText text) {
  return rangedParameter(value, range, std::move(text));
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  // Edits from each beginning of `a`, the last three of them, to each beginning of `b`.
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row.back();
}

std::string nearestName(const std::string& name, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(1, name.size() / kLettersPerTypo) + 1;
  for (const std::string& known : names) {
    const std::size_t edits = editsToEndOf(known, name);
    if (edits >= fewest) continue;
    fewest = edits;
    nearest = known;
  }
  return nearest;
}

std::string suggestionFor(const std::string& name, const std::vector<std::string>& names) {
  const std::string nearest = nearestName(name, names);
  return nearest.empty() ? std::string() : "did you mean '" + nearest + "'?";
}

}  // namespace occusg
