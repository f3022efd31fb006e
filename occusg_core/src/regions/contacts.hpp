// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "occusg/geometry/grid.hpp"

namespace occusg {

/// Two side by side cells of different labels.
struct CellPair {
  Cell low;   ///< The left or lower one.
  Cell high;  ///< The right or upper one.
};

/// A chain of cell edges along which two labels touch.
struct Contact {
  std::int32_t label_a = 0;     ///< Smaller label.
  std::int32_t label_b = 0;     ///< Larger label.
  Cell from;                    ///< Corner at one end, the smaller one.
  Cell to;                      ///< Corner at the other end.
  std::vector<CellPair> pairs;  ///< On either side of every edge, row-major.
};

/// Every chain of edges between two labels other than kNoRegion, ordered by labels, then by ends.
/// Of a closed or branching chain the two corners that lie farthest apart count as its ends.
[[nodiscard]] std::vector<Contact> contactsOf(const Grid<std::int32_t>& labels);

}  // namespace occusg
