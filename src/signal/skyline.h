// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sonar {

/// A symmetric matrix of which each row is kept from its first entry that is not nothing to the diagonal: normal equations
/// in which neighbours alone have to do with each other.
class Skyline {
 public:
  explicit Skyline(std::size_t size) : first_(size) {
    for (std::size_t i = 0; i < size; ++i) first_[i] = i;
  }
  /// Makes room for (row, column); all room is made before the first value.
  void reach(std::size_t row, std::size_t column);
  /// Values at 0.
  void clear();
  /// column <= row, within reach
  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return rows_[start_[row] + column - first_[row]]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const {
    return rows_[start_[row] + column - first_[row]];
  }
  [[nodiscard]] std::size_t size() const { return first_.size(); }
  [[nodiscard]] std::size_t first(std::size_t row) const { return first_[row]; }

 private:
  std::vector<std::size_t> first_;  ///< [row] column
  std::vector<std::size_t> start_;  ///< [row] in rows_
  std::vector<double> rows_;
};

/// Cholesky's root of a positive definite matrix.
class SkylineRoot {
 public:
  /// Nothing where the matrix is not positive definite.
  [[nodiscard]] static std::optional<SkylineRoot> of(Skyline matrix);
  /// Solves matrix * x = b in place.
  void solve(std::span<double> b) const;
  /// Entries of the inverse among some rising indices, [i][j].
  [[nodiscard]] std::vector<double> inverse_among(std::span<const std::size_t> indices) const;

 private:
  explicit SkylineRoot(Skyline root) : root_(std::move(root)) {}
  Skyline root_;
};

}  // namespace sonar
