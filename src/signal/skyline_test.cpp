// SPDX-License-Identifier: Apache-2.0
#include "signal/skyline.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace sonar {
namespace {

/// Rows that reach differently far: 4 on the diagonal, and a last row that reaches everything.
Skyline example(std::size_t size) {
  Skyline m(size);
  for (std::size_t i = 1; i < size; ++i) m.reach(i, i - 1);
  m.reach(size - 1, 0);
  m.clear();
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = m.first(i); j < i; ++j) m.at(i, j) = 0.3 / static_cast<double>(1 + i - j);
    m.at(i, i) = 4.0;
  }
  return m;
}

double value(const Skyline& m, std::size_t i, std::size_t j) {
  if (j > i) std::swap(i, j);
  return j < m.first(i) ? 0.0 : m.at(i, j);
}

TEST(SkylineRoot, SolvesWhatWasMultiplied) {
  constexpr std::size_t kSize = 9;
  const Skyline m = example(kSize);
  std::vector<double> x(kSize);
  for (std::size_t i = 0; i < kSize; ++i) x[i] = static_cast<double>(i * i) - 7.0;
  std::vector<double> b(kSize);
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j < kSize; ++j) b[i] += value(m, i, j) * x[j];
  }
  const auto root = SkylineRoot::of(m);
  ASSERT_TRUE(root);
  root->solve(b);
  for (std::size_t i = 0; i < kSize; ++i) EXPECT_NEAR(b[i], x[i], 1e-12);
}

TEST(SkylineRoot, TheInverseAmongSomeIsThatOfTheWhole) {
  constexpr std::size_t kSize = 9;
  const Skyline m = example(kSize);
  const auto root = SkylineRoot::of(m);
  ASSERT_TRUE(root);
  const std::array<std::size_t, 3> some = {2, 3, 7};
  const std::vector<double> inverse = root->inverse_among(some);
  for (std::size_t c = 0; c < some.size(); ++c) {
    std::vector<double> unit(kSize);
    unit[some[c]] = 1.0;
    root->solve(unit);
    for (std::size_t r = 0; r < some.size(); ++r) EXPECT_NEAR(inverse[r * some.size() + c], unit[some[r]], 1e-14);
  }
}

TEST(SkylineRoot, RefusesWhatIsNotPositiveDefinite) {
  Skyline m(2);
  m.reach(1, 0);
  m.clear();
  m.at(0, 0) = m.at(1, 1) = 1.0;
  m.at(1, 0) = 2.0;
  EXPECT_FALSE(SkylineRoot::of(m));
}

}  // namespace
}  // namespace sonar
