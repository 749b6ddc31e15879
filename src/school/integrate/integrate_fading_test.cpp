// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/units.h"
#include "school/integrate/test_integration.h"
#include "school/measure/fading_field.h"

namespace sonar {
namespace {

using Scene = test::IntegratedScene;

constexpr int kHeard = 280;  ///< samples, beyond what is integrated
constexpr CellLayout kLayout{.max_range_m = 100.0};

/// What is told of the variance of a cell's echo, mean of its pings, over how it scatters from ping to ping.
double told_over_scattered(const std::vector<CellSums>& pings) {
  const auto count = static_cast<double>(pings.size());
  double sum = 0.0;
  double squares = 0.0;
  double told = 0.0;
  for (const CellSums& cell : pings) {
    sum += cell.echo_m2;
    squares += cell.echo_m2 * cell.echo_m2;
    told += cell.variance_m4 / count;
  }
  return told / ((squares - sum * sum / count) / (count - 1.0));
}

TEST(IntegrateFading, the_error_by_fading_is_what_repeated_pings_scatter) {
  // Independent voxels of exponential echo: nothing of the sonar's overlap, which voxels_alike() tells.
  Scene scene;
  scene.pulse_m = 0.0;
  scene.grid.vertical_width_deg.assign(500, 0.1);
  scene.grid.horizontal_width_deg.assign(500, 0.1);
  std::vector<CellSums> pings;
  std::uint64_t seed = 1;
  while (pings.size() < 60) {
    for (int row = 0; row < 500; ++row) {
      for (std::size_t s = 0; s < kHeard; ++s) {
        scene.sv.view().row(row)[s] = count_from_linear(-1e-7 * std::log(test::uniform(seed++)));
      }
    }
    const PingCells cells = scene.integrated(kLayout);
    // Two channels together, whose common voxels fade as one.
    EXPECT_GT(cells.at(1, 3).whole_m4, cells.at(1, 3).variance_m4);
    EXPECT_GT(cells.at(1, 4).whole_m4, cells.at(1, 4).variance_m4);
    pings.push_back(cells.at(1, 3));
  }
  // Of 60 pings a variance is known to 18 % (one standard error).
  EXPECT_NEAR(told_over_scattered(pings), 1.0, 0.55);
}

TEST(IntegrateFading, the_error_by_fading_holds_where_beams_and_samples_overlap) {
  // Fans of own frequency, as an MS70's: counting them as alike would make it three times the variance.
  Scene scene;
  for (std::size_t fan = 0; fan < 20; ++fan) scene.grid.frequency_hz[fan] += 2000.0 * static_cast<double>(fan);
  const IndexBox all{0, 19, 0, 24, 0, kHeard - 1};
  const FadingField field(scene.grid, all, scene.sector.range().spacing_m, scene.pulse_m);
  std::vector<CellSums> pings;
  while (pings.size() < 80) {
    const Array3<std::int16_t> fading = field.draw(pings.size());
    for (int row = 0; row < 500; ++row) {
      for (std::size_t s = 0; s < kHeard; ++s) {
        scene.sv.view().row(row)[s] = count_from_linear(1e-7 * linear_from_count(fading.view().row(row)[s]));
      }
    }
    pings.push_back(scene.integrated(kLayout).at(1, 3));
  }
  // Of 80 pings a variance is known to 16 % (one standard error); of 600 it was 1.23: what lies beyond the cell's ends counts
  // in what is told. Without any overlap it would be 0.3, with fans alike 3.6.
  EXPECT_NEAR(told_over_scattered(pings), 1.23, 0.5);
}

}  // namespace
}  // namespace sonar
