// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "occusg/io/results.hpp"

namespace occusg {

/// The bytes of `overview.png`: the map with all that was found; of a building with several storeys
/// a panel for each, from the lowest up, at most `kMostPanels`, with the stairs that lead to it.
[[nodiscard]] std::string overviewPng(const Findings& findings, const RoomsFile& rooms);

}  // namespace occusg
