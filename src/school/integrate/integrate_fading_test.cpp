// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/units.h"
#include "school/integrate/test_integration.h"
#include "school/measure/fading_field.h"

namespace sonar {
namespace {

using Scene = test::IntegratedScene;

TEST(IntegrateFading, the_error_by_fading_is_what_repeated_pings_scatter) {
  // Independent voxels of exponential echo: nothing of the sonar's overlap, which voxels_alike() tells.
  Scene scene;
  scene.grid.vertical_width_deg.assign(500, 0.1);
  scene.grid.horizontal_width_deg.assign(500, 0.1);
  constexpr int kPings = 60;
  double sum = 0.0;
  double squares = 0.0;
  double told = 0.0;
  std::uint64_t seed = 1;
  CellLayout layout;
  layout.max_range_m = 100.0;
  for (int ping = 0; ping < kPings; ++ping) {
    for (int row = 0; row < 500; ++row) {
      for (int s = 0; s < 280; ++s) {
        scene.sv.view().row(row)[static_cast<std::size_t>(s)] =
            count_from_linear(-1e-7 * std::log(test::uniform(seed++)));
      }
    }
    IntegrationInput input;
    input.sv = scene.sv.view();
    input.flags = scene.flags.view();
    input.sector = &scene.sector;
    input.grid = &scene.grid;
    input.placement = scene.placement;
    const PingCells cells = integrate_ping(input, layout);
    // Two channels together, whose common voxels fade as one.
    const CellSums& a = cells.at(1, 3);
    const CellSums& b = cells.at(1, 4);
    sum += a.echo_m2;
    squares += a.echo_m2 * a.echo_m2;
    told += a.variance_m4;
    EXPECT_GT(a.whole_m4, a.variance_m4);
    EXPECT_GT(b.whole_m4, b.variance_m4);
  }
  const double scatter = (squares - sum * sum / kPings) / (kPings - 1);
  // Of 60 pings a variance is known to 18 % (one standard error).
  EXPECT_NEAR(told / kPings / scatter, 1.0, 0.55);
}

TEST(IntegrateFading, the_error_by_fading_holds_where_beams_and_samples_overlap) {
  // Fans of own frequency, as an MS70's: counting them as alike would make it three times the variance.
  Scene scene;
  for (std::size_t fan = 0; fan < 20; ++fan) scene.grid.frequency_hz[fan] += 2000.0 * static_cast<double>(fan);
  constexpr int kPings = 80;
  constexpr double kPulse_m = 1.5;
  const IndexBox all{0, 19, 0, 24, 0, 279};
  const FadingField field(scene.grid, all, scene.sector.range().spacing_m, kPulse_m);
  CellLayout layout;
  layout.max_range_m = 100.0;
  double sum = 0.0;
  double squares = 0.0;
  double told = 0.0;
  for (std::uint64_t ping = 0; ping < kPings; ++ping) {
    const Array3<std::int16_t> fading = field.draw(ping);
    for (int row = 0; row < 500; ++row) {
      for (std::size_t s = 0; s < 280; ++s) {
        scene.sv.view().row(row)[s] = count_from_linear(1e-7 * linear_from_count(fading.view().row(row)[s]));
      }
    }
    IntegrationInput input;
    input.sv = scene.sv.view();
    input.flags = scene.flags.view();
    input.sector = &scene.sector;
    input.grid = &scene.grid;
    input.placement = scene.placement;
    input.pulse_m = kPulse_m;
    const CellSums cell = integrate_ping(input, layout).at(1, 3);
    sum += cell.echo_m2;
    squares += cell.echo_m2 * cell.echo_m2;
    told += cell.variance_m4 / kPings;
  }
  const double scatter = (squares - sum * sum / kPings) / (kPings - 1);
  // Of 80 pings a variance is known to 16 % (one standard error); of 600 it was 1.23: what lies beyond the cell's ends counts
  // in what is told. Without any overlap it would be 0.3, with fans alike 3.6.
  EXPECT_NEAR(told / scatter, 1.23, 0.5);
}

}  // namespace
}  // namespace sonar
