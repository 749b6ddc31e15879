// SPDX-License-Identifier: Apache-2.0
#include "school/measure/nuclei.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "base/units.h"

namespace sonar {
namespace {

/// A brick of 3 x 3 beams and 60 samples in which the echo follows a profile along range.
int nuclei_of(const std::vector<int>& counts) {
  Array3<std::int16_t> filtered(Shape3{20, 25, 900});
  PingMask mask;
  for (int fan = 5; fan < 8; ++fan) {
    for (int beam = 10; beam < 13; ++beam) {
      mask.runs.push_back({fan * 25 + beam, 100, static_cast<int>(counts.size())});
      const auto row = filtered.view().row(fan * 25 + beam);
      std::transform(counts.begin(), counts.end(), row.begin() + 100,
                     [](int c) { return static_cast<std::int16_t>(c - 4000); });
    }
  }
  mask.confidence.assign(9 * counts.size(), 255);
  return count_nuclei(mask, std::as_const(filtered).view());
}

TEST(Nuclei, AreMaximaWithHalfTheEchoBetween) {
  EXPECT_EQ(nuclei_of({0, 0, 0}), 1) << "evenly dense";
  EXPECT_EQ(nuclei_of({0, 300, 600, 300, 0}), 1);
  EXPECT_EQ(nuclei_of({0, 600, 344, 700, 0}), 2) << "256 counts are half";
  EXPECT_EQ(nuclei_of({0, 600, 345, 700, 0}), 1) << "a little less than that between";
  EXPECT_EQ(nuclei_of({0, 600, 300, 500, 100, 900, 0}), 2) << "500 stands 200 above its saddle";
  EXPECT_EQ(nuclei_of({0, 600, 200, 500, 100, 900, 0}), 3);
}

TEST(Nuclei, PiecesApartCountWhereTheyHaveACore) {
  Array3<std::int16_t> filtered(Shape3{20, 25, 900});
  const auto row = filtered.view().row(260);
  for (int s = 0; s < 5; ++s) {
    row[static_cast<std::size_t>(100 + s)] = static_cast<std::int16_t>(-4000 + (s == 2 ? 400 : 0));
    row[static_cast<std::size_t>(200 + s)] = static_cast<std::int16_t>(-4000 + (s == 2 ? 300 : 0));
    row[static_cast<std::size_t>(300 + s)] = static_cast<std::int16_t>(-4000 + (s == 2 ? 200 : 0));
  }
  const PingMask mask{{{260, 100, 5}, {260, 200, 5}, {260, 300, 5}}, std::vector<std::uint8_t>(15, 255)};
  EXPECT_EQ(count_nuclei(mask, std::as_const(filtered).view()), 2);
  std::fill(row.begin(), row.end(), kNoData);
  EXPECT_EQ(count_nuclei(mask, std::as_const(filtered).view()), 0);
}

}  // namespace
}  // namespace sonar
