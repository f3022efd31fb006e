// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>

#include "occusg/error.hpp"

namespace occusg {

/// @throws Error naming `key` unless `lowest` <= `value` <= `highest` (so not for NaN either).
inline void requireRange(const std::string& key, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  std::ostringstream wrong;
  std::ostringstream right;
  wrong << value << " is out of range";
  right << "must be between " << lowest << " and " << highest;
  throw refuse(key, wrong.str(), right.str());
}

}  // namespace occusg
