// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace occusg {

/// Text made fit for HTML content and attribute values.
[[nodiscard]] std::string escaped(const std::string& text);

/// A share as the paper prints it: ".427", "1.00", an en dash where it is undefined.
[[nodiscard]] std::string shownShare(const std::optional<double>& value);
/// With a sign: "+.031", "−.120".
[[nodiscard]] std::string shownDifference(double value);
/// With `digits` decimals.
[[nodiscard]] std::string shownNumber(double value, int digits);

/// A cell: its content as HTML, and attributes such as `class="best"`.
struct HtmlCell {
  std::string content;
  std::string attributes = {};
};

/// One row of a table; the first cell of a body row is its header.
using HtmlRow = std::vector<HtmlCell>;

/// A table with caption, header rows, body and summary rows (below a line).
struct HtmlTable {
  std::string id;
  std::string caption;  ///< HTML.
  std::vector<HtmlRow> header;
  std::vector<HtmlRow> body;
  std::vector<HtmlRow> summary = {};
};

[[nodiscard]] std::string toHtml(const HtmlTable& table);

}  // namespace occusg
