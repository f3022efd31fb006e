// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace occusg {

/// Optimal one-to-one assignment of rows to columns (Kuhn 1955; shortest augmenting paths with
/// potentials, Jonker and Volgenant 1987), O(rows^2 columns) for rows <= columns, else the other
/// way round. Deterministic: among equally good assignments always the same one.
/// @param weights `weights[row][column]`, rows of equal length; any finite values.
/// @return for each row its column, or -1. min(rows, columns) rows have one, so that the sum of
/// their weights is largest.
/// @throws Error when the rows differ in length or a weight is not finite.
[[nodiscard]] std::vector<int> maxSumAssignment(const std::vector<std::vector<double>>& weights);

}  // namespace occusg
