// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "base/array.h"
#include "model/product.h"
#include "synth/beam_pattern.h"
#include "synth/beam_table.h"

namespace sonar::synth {

/// One beam's two-way pattern, normalised so that homogeneous water keeps its sv.
struct RowBeam {
  int channel = 0;
  int count = 0;                    ///< samples recorded
  double elevation_rad = 0.0;       ///< positive up
  double azimuth_rad = 0.0;         ///< clockwise from the bow, not wrapped
  double sigma_v_rad = 0.0;         ///< of the two-way Gaussian = one-way width / (4 sqrt(ln 2))
  double sigma_h_rad = 0.0;         ///< along the arc
  double vertical_width_rad = 0.0;  ///< one-way, -3 dB
};

/// Which beam stands in which row, and where its samples lie.
/// With a product grid row = fan * beams + beam; without one row = channel, one "fan" of all beams.
struct Layout {
  std::vector<Beam> beams;    ///< [channel]
  std::vector<RowBeam> rows;  ///< [row]
  std::optional<GridRecord> grid;
  Shape3 shape;
  RangeAxis range;
  BeamPattern pattern = BeamPattern::gaussian;
  double mounting_azimuth_deg = 270.0;
  double max_sigma_v_rad = 0.0;
  double max_sigma_h_rad = 0.0;

  [[nodiscard]] const Beam& beam(int row) const {
    return beams[static_cast<std::size_t>(rows[static_cast<std::size_t>(row)].channel)];
  }
};

/// The beams with their equivalent beam angles: the pattern's own where has_own_beam_angle(),
/// else the table's.
[[nodiscard]] std::vector<Beam> sounding_beams(std::vector<Beam> beams, BeamPattern pattern);

/// Vertical two-way pattern as a density over elevation, rad^-1; 0 beyond its reach.
[[nodiscard]] double vertical_density(BeamPattern pattern, const RowBeam& row, double elevation_rad);

[[nodiscard]] Layout make_layout(std::vector<Beam> beams, BeamPattern pattern = BeamPattern::gaussian);

}  // namespace sonar::synth
