// SPDX-License-Identifier: Apache-2.0
#include "signal/skyline.h"

#include <algorithm>
#include <cmath>

namespace sonar {

void Skyline::reach(std::size_t row, std::size_t column) {
  const auto [low, high] = std::minmax(row, column);
  first_[high] = std::min(first_[high], low);
}

void Skyline::clear() {
  std::size_t room = 0;
  start_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    start_.push_back(room);
    room += i - first_[i] + 1;
  }
  rows_.assign(room, 0.0);
}

std::optional<SkylineRoot> SkylineRoot::of(Skyline m) {
  for (std::size_t i = 0; i < m.size(); ++i) {
    for (std::size_t j = m.first(i); j <= i; ++j) {
      double sum = m.at(i, j);
      for (std::size_t k = std::max(m.first(i), m.first(j)); k < j; ++k) sum -= m.at(i, k) * m.at(j, k);
      if (j < i) {
        m.at(i, j) = sum / m.at(j, j);
      } else {
        if (!(sum > 0.0)) return std::nullopt;
        m.at(i, i) = std::sqrt(sum);
      }
    }
  }
  return SkylineRoot(std::move(m));
}

void SkylineRoot::solve(std::span<double> b) const {
  for (std::size_t i = 0; i < root_.size(); ++i) {
    for (std::size_t k = root_.first(i); k < i; ++k) b[i] -= root_.at(i, k) * b[k];
    b[i] /= root_.at(i, i);
  }
  for (std::size_t i = root_.size(); i-- > 0;) {
    b[i] /= root_.at(i, i);
    for (std::size_t k = root_.first(i); k < i; ++k) b[k] -= root_.at(i, k) * b[i];
  }
}

std::vector<double> SkylineRoot::inverse_among(std::span<const std::size_t> indices) const {
  const std::size_t n = indices.size();
  const std::size_t size = root_.size();
  const std::size_t begin = indices.empty() ? 0 : indices.front();
  // The inverse is that of the root, times its transpose: columns of the former are enough.
  std::vector<std::vector<double>> columns(n, std::vector<double>(size - begin));
  for (std::size_t c = 0; c < n; ++c) {
    std::vector<double>& x = columns[c];
    x[indices[c] - begin] = 1.0;
    for (std::size_t i = indices[c]; i < size; ++i) {
      double sum = x[i - begin];
      for (std::size_t k = std::max(root_.first(i), indices[c]); k < i; ++k) sum -= root_.at(i, k) * x[k - begin];
      x[i - begin] = sum / root_.at(i, i);
    }
  }
  std::vector<double> inverse;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < size - begin; ++k) sum += columns[i][k] * columns[j][k];
      inverse.push_back(sum);
    }
  }
  return inverse;
}

}  // namespace sonar
