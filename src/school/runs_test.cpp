// SPDX-License-Identifier: Apache-2.0
#include "school/runs.h"

#include <gtest/gtest.h>

#include <vector>

#include "school/test_water.h"

namespace sonar {
namespace {

/// Labels voxel by voxel with a queue: the plain twin.
std::vector<int> plain_labels(const Array3<std::uint8_t>& in, bool all, int& count) {
  const Shape3 shape = in.shape();
  std::vector<int> label(shape.size(), -1);
  const auto at = [&](int f, int b, int s) {
    return (static_cast<std::size_t>(f) * static_cast<std::size_t>(shape.beams) + static_cast<std::size_t>(b)) *
               static_cast<std::size_t>(shape.samples) +
           static_cast<std::size_t>(s);
  };
  count = 0;
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < shape.samples; ++s) {
        if (in(f, b, s) == 0 || label[at(f, b, s)] >= 0) continue;
        std::vector<std::array<int, 3>> queue{{f, b, s}};
        label[at(f, b, s)] = count;
        while (!queue.empty()) {
          const auto v = queue.back();
          queue.pop_back();
          for (int df = -1; df <= 1; ++df) {
            for (int db = -1; db <= 1; ++db) {
              for (int ds = -1; ds <= 1; ++ds) {
                if (!all && std::abs(df) + std::abs(db) + std::abs(ds) != 1) continue;
                const int nf = v[0] + df;
                const int nb = v[1] + db;
                const int ns = v[2] + ds;
                if (nf < 0 || nf >= shape.fans || nb < 0 || nb >= shape.beams || ns < 0 || ns >= shape.samples)
                  continue;
                if (in(nf, nb, ns) == 0 || label[at(nf, nb, ns)] >= 0) continue;
                label[at(nf, nb, ns)] = count;
                queue.push_back({nf, nb, ns});
              }
            }
          }
        }
        ++count;
      }
    }
  }
  return label;
}

TEST(Runs, LabelsEqualThePlainTwin) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Shape3 shape{1 + static_cast<int>(seed % 5), 1 + static_cast<int>(seed % 7), 31};
    Array3<std::uint8_t> in(shape);
    const double share = 0.2 + 0.6 * test::uniform(seed + 1000);
    for (std::size_t i = 0; i < shape.size(); ++i) in.all()[i] = test::uniform(seed * 7919 + i) < share ? 1 : 0;
    std::vector<sonar::Run> runs;
    for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
      for (int s = 0; s < shape.samples; ++s) {
        if (in.view().row(row)[static_cast<std::size_t>(s)] == 0) continue;
        if (runs.empty() || runs.back().row != row || runs.back().end() != s) runs.push_back({row, s, 0});
        ++runs.back().count;
      }
    }
    for (const bool all : {false, true}) {
      int expected_count = 0;
      const std::vector<int> expected = plain_labels(in, all, expected_count);
      const Components got = label_runs(runs, shape, all ? Connectivity::all : Connectivity::faces);
      ASSERT_EQ(got.count, expected_count);
      for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto voxel = static_cast<std::size_t>(runs[i].row) * 31U + static_cast<std::size_t>(runs[i].first_sample);
        ASSERT_EQ(got.label[i], expected[voxel]);
      }
    }
  }
}

TEST(Runs, BoxHoldsTheMask) {
  PingMask mask;
  mask.runs = {{7, 4, 3}, {12, 2, 2}};
  EXPECT_EQ(box_of(mask, 5), (IndexBox{1, 2, 2, 2, 2, 6}));
  EXPECT_TRUE(box_of({}, 5).empty());
}

}  // namespace
}  // namespace sonar
