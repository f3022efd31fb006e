// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

namespace occusg_ros {

/// Text of a message, made fit for a log and for diagnostics: a peer may send megabytes, and
/// characters that a terminal obeys. The text says how much was cut off.
[[nodiscard]] inline std::string shownText(const std::string& text, std::size_t longest = 400) {
  std::string shown = text.substr(0, longest);
  std::replace_if(
      shown.begin(), shown.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }, '?');
  if (text.size() > longest) shown += "... (" + std::to_string(text.size()) + " bytes)";
  return shown;
}

/// The same for a name in a sentence.
[[nodiscard]] inline std::string shownName(const std::string& name) {
  constexpr std::size_t kLongestName = 80;
  return shownText(name, kLongestName);
}

}  // namespace occusg_ros
