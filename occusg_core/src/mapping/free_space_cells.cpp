// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/mapping/free_space_cells.hpp"

namespace occusg {

FreeSpaceCells::FreeSpaceCells(const Grid<std::int8_t>& values) : box_(values.box()) {
  tiles_.assign(values);
}

std::size_t FreeSpaceCells::size() const {
  return static_cast<std::size_t>(box_.width()) * static_cast<std::size_t>(box_.height());
}

}  // namespace occusg
