// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/assignment.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "occusg/error.hpp"

namespace occusg {
namespace {

using Matrix = std::vector<std::vector<double>>;

void check(const Matrix& weights) {
  for (std::size_t row = 0; row < weights.size(); ++row) {
    const std::string where = "assignment weights, row " + std::to_string(row);
    if (weights[row].size() != weights.front().size()) {
      throw refuse(where, std::to_string(weights[row].size()) + " columns",
                   "must be as many as in row 0, " + std::to_string(weights.front().size()));
    }
    for (const double weight : weights[row])
      if (!std::isfinite(weight)) throw refuse(where, std::to_string(weight), "must be finite");
  }
}

Matrix transposed(const Matrix& matrix) {
  Matrix result(matrix.front().size(), std::vector<double>(matrix.size()));
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    for (std::size_t column = 0; column < matrix[row].size(); ++column)
      result[column][row] = matrix[row][column];
  }
  return result;
}

/// Adds one row at a time along the cheapest alternating path. Row and column 0 are virtual: the
/// row being added sits at column 0 until a free column is found.
class Assigner {
 public:
  explicit Assigner(const Matrix& weights)
      : weights_(weights),
        columns_(weights.front().size()),
        row_potential_(weights.size() + 1, 0.0),
        column_potential_(columns_ + 1, 0.0),
        row_of_column_(columns_ + 1, 0) {}

  std::vector<int> solve() {
    for (std::size_t row = 1; row <= weights_.size(); ++row) addRow(row);
    std::vector<int> column_of_row(weights_.size(), -1);
    for (std::size_t column = 1; column <= columns_; ++column) {
      if (row_of_column_[column] != 0)
        column_of_row[row_of_column_[column] - 1] = static_cast<int>(column - 1);
    }
    return column_of_row;
  }

 private:
  [[nodiscard]] double reducedCost(std::size_t row, std::size_t column) const {
    return -weights_[row - 1][column - 1] - row_potential_[row] - column_potential_[column];
  }

  void addRow(std::size_t new_row) {
    std::vector<double> distance(columns_ + 1, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> previous(columns_ + 1, 0);
    std::vector<bool> settled(columns_ + 1, false);
    row_of_column_[0] = new_row;
    std::size_t column = 0;
    do {
      settled[column] = true;
      column = advance(column, settled, distance, previous);
    } while (row_of_column_[column] != 0);
    while (column != 0) {
      row_of_column_[column] = row_of_column_[previous[column]];
      column = previous[column];
    }
  }

  /// Relaxes the edges of the row at `column` and returns the nearest column not yet settled.
  std::size_t advance(std::size_t column, const std::vector<bool>& settled,
                      std::vector<double>& distance, std::vector<std::size_t>& previous) {
    const std::size_t row = row_of_column_[column];
    std::size_t nearest = 0;
    for (std::size_t other = 1; other <= columns_; ++other) {
      if (settled[other]) continue;
      const double cost = reducedCost(row, other);
      if (cost < distance[other]) {
        distance[other] = cost;
        previous[other] = column;
      }
      if (nearest == 0 || distance[other] < distance[nearest]) nearest = other;
    }
    const double step = distance[nearest];
    for (std::size_t other = 0; other <= columns_; ++other) {
      if (settled[other]) {
        row_potential_[row_of_column_[other]] += step;
        column_potential_[other] -= step;
      } else {
        distance[other] -= step;
      }
    }
    return nearest;
  }

  const Matrix& weights_;
  std::size_t columns_;
  std::vector<double> row_potential_;
  std::vector<double> column_potential_;
  std::vector<std::size_t> row_of_column_;  ///< 0 = free.
};

}  // namespace

std::vector<int> maxSumAssignment(const Matrix& weights) {
  check(weights);
  if (weights.empty() || weights.front().empty()) return std::vector<int>(weights.size(), -1);
  if (weights.size() <= weights.front().size()) return Assigner(weights).solve();
  const std::vector<int> row_of_column = Assigner(transposed(weights)).solve();
  std::vector<int> column_of_row(weights.size(), -1);
  for (std::size_t column = 0; column < row_of_column.size(); ++column)
    column_of_row[static_cast<std::size_t>(row_of_column[column])] = static_cast<int>(column);
  return column_of_row;
}

}  // namespace occusg
