// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "evaluation/score_estimates.hpp"
#include "report/html_text.hpp"
#include "report/scene_result.hpp"

namespace occusg {

/// What the tables of a report share.

/// "A", "B", ..., the short names of configurations in the heads of wide tables.
[[nodiscard]] std::string letterOf(std::size_t configuration);
/// Letter and name.
[[nodiscard]] std::string lettered(const BatchResults& batch, std::size_t configuration);
/// Attribute of a head above several columns.
[[nodiscard]] std::string spanning(std::size_t columns);
/// The value, its interval small below it.
[[nodiscard]] HtmlCell estimateCell(const Estimate& estimate);
/// Of the configuration's results, how many `holds` is true of.
[[nodiscard]] std::size_t countOf(const BatchResults& batch, const std::string& configuration,
                                  const std::function<bool(const SceneResult&)>& holds);

}  // namespace occusg
