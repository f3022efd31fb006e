// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_cells.hpp"

#include <algorithm>

namespace occusg {

std::string letterOf(std::size_t configuration) {
  const std::string letter(1, static_cast<char>('A' + configuration % 26));
  return configuration < 26 ? letter : letter + std::to_string(configuration / 26);
}

std::string spanning(std::size_t columns) { return "colspan=\"" + std::to_string(columns) + "\""; }

std::string lettered(const BatchResults& batch, std::size_t configuration) {
  return "<b class=\"letter\">" + letterOf(configuration) + "</b> " +
         escaped(batch.configurations[configuration]);
}

HtmlCell estimateCell(const Estimate& estimate) {
  std::string html = shownShare(estimate.value);
  if (estimate.confidence_95) {
    html += "<small>" + shownShare(estimate.confidence_95->low) + "–" +
            shownShare(estimate.confidence_95->high) + "</small>";
  }
  return {html};
}

std::size_t countOf(const BatchResults& batch, const std::string& configuration,
                    const std::function<bool(const SceneResult&)>& holds) {
  return static_cast<std::size_t>(
      std::count_if(batch.results.begin(), batch.results.end(), [&](const SceneResult& result) {
        return result.configuration == configuration && holds(result);
      }));
}

}  // namespace occusg
