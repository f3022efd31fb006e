// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/scene_result.hpp"

namespace occusg {

/// `report.html`: one page with averages and intervals, the tables of the paper's form, run times,
/// the rooms found worst, and a drawing of every scene with the truth outlined. Self-contained: no
/// script, nothing loaded. Equal results give equal bytes.
/// @param title heading of the page.
[[nodiscard]] std::string reportPage(const BatchResults& batch, const std::string& title);

}  // namespace occusg
