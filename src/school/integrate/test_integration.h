// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/units.h"
#include "school/integrate/integrate_ping.h"
#include "school/test_water.h"

namespace sonar::test {

inline constexpr double kTransducer_m = 7.0;
inline constexpr int kSamples = 700;  // 263 m

/// A sonar in water of expected s_v by fan and sample, the same in all beams, without fading.
struct IntegratedScene {
  BeamGrid grid = test::grid();
  Sector sector = grid.sector(range_axis(kSamples));
  Array3<std::int16_t> sv{Shape3{20, 25, kSamples}, kNoData};
  Array3<SampleFlags> flags{Shape3{20, 25, kSamples}, SampleFlags::none};
  Array3<std::int16_t> calibration{Shape3{20, 25, kSamples}, 0};
  std::vector<double> background_db = {};
  std::vector<const PingMask*> schools = {};
  ExtinctionParams extinction = {};
  const Array3<std::int16_t>* filtered = nullptr;  ///< null = none
  double pulse_m = 1.5;
  Seabed seabed = {};
  Placement placement{{60.0, 5.0}, 0.3, kTransducer_m};

  void fill(const std::function<double(int fan, int sample)>& expected) {
    for (int fan = 0; fan < 20; ++fan) {
      for (int s = 0; s < kSamples; ++s) {
        const std::int16_t count = count_from_linear(expected(fan, s));
        for (int beam = 0; beam < 25; ++beam) sv.view().row(fan * 25 + beam)[static_cast<std::size_t>(s)] = count;
      }
    }
  }
  [[nodiscard]] PingCells integrated(const CellLayout& layout) const {
    IntegrationInput ping;
    ping.sv = sv.view();
    ping.flags = flags.view();
    ping.sector = &sector;
    ping.grid = &grid;
    ping.background = {background_db, calibration.view()};
    ping.placement = placement;
    ping.pulse_m = pulse_m;
    ping.schools = schools;
    ping.extinction = extinction;
    if (filtered != nullptr) ping.filtered = filtered->view();
    ping.seabed = &seabed;
    return integrate_ping(ping, layout);
  }
};

inline double sv_db(const CellSums& cell) { return db_from_linear(cell.echo_m2 / cell.heard_m3); }

}  // namespace sonar::test
