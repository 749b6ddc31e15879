// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz target of a user's beam table does; the plain tests replay its corpus through the same function.

#include <cmath>
#include <string>
#include <string_view>

#include "base/check.h"
#include "model/beam_grid.h"
#include "synth/beam_table.h"

namespace sonar::fuzz {

/// A table that is taken holds possible beams; what they say in CON0 and CON1 makes a grid of all of them, or none.
inline void beam_table(std::string_view text) {
  const auto beams = synth::parse_beam_table(std::string(text), "fuzz");
  if (!beams) return;
  SONAR_CHECK(!beams->empty());
  for (const synth::Beam& beam : *beams) {
    SONAR_CHECK(std::abs(beam.elevation_deg) <= 90.0 && std::abs(beam.azimuth_deg) <= 180.0 && beam.count > 0);
    SONAR_CHECK(beam.frequency_hz > 0.0 && beam.power_w > 0.0 && std::isfinite(beam.gain_db));
  }
  const auto grid = derive_beam_grid(synth::sounder_config(*beams, "SYNTHETIC"), 270.0);
  if (!grid) return;
  SONAR_CHECK(grid->channel.size() == beams->size());
  const double volume_m3 = grid->sector({-1.0, 0.4, 10}).volume_m3(0, 0, 9);
  SONAR_CHECK(volume_m3 >= 0.0 && std::isfinite(volume_m3));
}

}  // namespace sonar::fuzz
