// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace occusg {

/// One configurable value: where it lives, what it means and what it may be. Values travel as text,
/// as they stand in a YAML file; numbers are written so that they read back unchanged.
struct Parameter {
  std::string key;          ///< Dotted, e.g. "regions.tracker.min_overlap".
  std::string unit;         ///< "m", "s", "pixels", ... or empty.
  std::string allowed;      ///< "[0, 1]" or "drop | clear".
  std::string description;  ///< One sentence.
  std::string paper;        ///< The published system's value; empty: as the default.

  std::function<std::string()> print;
  /// Takes the value; false, and nothing changed, when the text is not one of the allowed values.
  std::function<bool(std::string_view)> assign;
  /// Whether the value itself is one of the allowed ones.
  std::function<bool()> holds;
};

/// @throws Error naming the first parameter whose value is not allowed, the value and the range.
void check(const std::vector<Parameter>& parameters);

/// The same for a struct that has a table; returns it, for initialisers.
template <typename Config>
const Config& checked(const Config& config) {
  Config copy = config;
  check(parametersOf(copy));
  return config;
}

/// Closed range of a number.
template <typename T>
struct Range {
  T min;
  T max;
};

/// A parameter's fixed texts.
struct ParameterText {
  std::string key;
  std::string unit;
  std::string description;
  std::string paper = {};
};

/// @param value outlives the parameter.
[[nodiscard]] Parameter numberParameter(double& value, Range<double> range, ParameterText text);
[[nodiscard]] Parameter countParameter(int& value, Range<int> range, ParameterText text);

/// A parameter that takes one of a few names.
template <typename Enum>
[[nodiscard]] Parameter choiceParameter(Enum& value,
                                        std::vector<std::pair<std::string, Enum>> choices,
                                        ParameterText text) {
  std::string allowed;
  for (const auto& choice : choices) allowed += (allowed.empty() ? "" : " | ") + choice.first;
  Parameter parameter{std::move(text.key),
                      std::move(text.unit),
                      std::move(allowed),
                      std::move(text.description),
                      std::move(text.paper),
                      {},
                      {},
                      {}};
  parameter.print = [&value, choices] {
    for (const auto& choice : choices)
      if (choice.second == value) return choice.first;
    return std::string();
  };
  parameter.holds = [&value, choices] {
    return std::any_of(choices.begin(), choices.end(),
                       [&value](const auto& choice) { return choice.second == value; });
  };
  parameter.assign = [&value, choices = std::move(choices)](std::string_view name) {
    for (const auto& choice : choices) {
      if (choice.first != name) continue;
      value = choice.second;
      return true;
    }
    return false;
  };
  return parameter;
}

/// Shortest decimal text that reads back as `value`; ".inf" and "-.inf" as in YAML.
[[nodiscard]] std::string shortestText(double value);

/// Bytes to be added, removed, replaced or swapped with the next to make `b` of `a` (Damerau).
[[nodiscard]] std::size_t editDistance(const std::string& a, const std::string& b);

/// The name in `names` that a user who typed `name` may have meant: fewest edits, at most one in
/// three letters, where what stands before a dot may be missing; empty when there is none.
[[nodiscard]] std::string nearestName(const std::string& name,
                                      const std::vector<std::string>& names);

/// "did you mean 'NAME'?" with the nearest name; empty when there is none.
[[nodiscard]] std::string suggestionFor(const std::string& name,
                                        const std::vector<std::string>& names);

}  // namespace occusg
