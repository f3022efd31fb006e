// SPDX-License-Identifier: BSD-3-Clause
#include "report/html_text.hpp"

#include <cmath>
#include <cstdio>

namespace occusg {
namespace {

std::string rowHtml(const HtmlRow& row, bool is_header) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool heads = is_header || i == 0;
    const std::string scope = is_header ? "" : " scope=\"row\"";
    html += heads ? "<th" + scope : std::string("<td");
    if (!row[i].attributes.empty()) html += " " + row[i].attributes;
    html += ">" + row[i].content + (heads ? "</th>" : "</td>");
  }
  return html + "</tr>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string shownNumber(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string shownShare(const std::optional<double>& value) {
  if (!value) return "–";
  if (*value >= 0.9995) return shownNumber(*value, 2);
  return shownNumber(*value, 3).substr(1);
}

std::string shownDifference(double value) {
  std::string size = shownShare(std::abs(value));
  if (size == ".000") return size;
  return (value < 0.0 ? "−" : "+") + size;
}

std::string toHtml(const HtmlTable& table) {
  std::string html = "<div class=\"wide\"><table id=\"" + table.id + "\">\n<caption>" +
                     table.caption + "</caption>\n<thead>";
  for (const HtmlRow& row : table.header) html += rowHtml(row, true);
  html += "</thead>\n<tbody>";
  for (const HtmlRow& row : table.body) html += rowHtml(row, false);
  html += "</tbody>\n";
  if (!table.summary.empty()) {
    html += "<tfoot>";
    for (const HtmlRow& row : table.summary) html += rowHtml(row, false);
    html += "</tfoot>\n";
  }
  return html + "</table></div>\n";
}

}  // namespace occusg
