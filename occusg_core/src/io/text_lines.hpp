// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace occusg {

/// A line of a list file that is neither blank nor a comment (`#`).
struct TextLine {
  std::size_t number = 0;  ///< From 1.
  std::string text;        ///< Without the line end; cut at kMaxLineLength + 1.
};

inline constexpr std::size_t kMaxLineLength = 1000;
inline constexpr std::size_t kMaxLines = 1'000'000;

/// The lines of a list file; line ends may be LF or CRLF, the last one may be missing.
/// @throws Error when the file cannot be read, or is longer than the limits.
[[nodiscard]] std::vector<TextLine> readLines(const std::string& path);

/// "path:number", how a sentence names the line.
[[nodiscard]] std::string placeOf(const std::string& path, const TextLine& line);

/// Words separated by spaces or tabs.
[[nodiscard]] std::vector<std::string> wordsOf(const std::string& text);

/// A finite decimal number that fills the whole word, in any locale; empty for anything else.
[[nodiscard]] std::optional<double> numberIn(const std::string& word);

/// A number and what it counts, in the plural where there is not one.
[[nodiscard]] std::string counted(std::size_t count, const std::string& one);

/// A byte no name or sentence should hold: a zero, a line end, the start of a terminal command.
[[nodiscard]] bool isControl(char c);

/// Text from a file, made fit for a sentence: shortened, and control characters replaced.
[[nodiscard]] std::string shown(const std::string& text);

}  // namespace occusg
