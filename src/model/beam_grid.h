// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/result.h"
#include "geo/sector.h"
#include "model/sounder.h"

namespace sonar {

/// The product grid of a sonar's beams: every fan has the same azimuths. Fans rise in elevation (0 = deepest), beams in
/// azimuth (0 = most aft on a port-looking MS70).
struct BeamGrid {
  std::vector<double> elevation_deg;         ///< [fan], positive up
  std::vector<double> azimuth_deg;           ///< [beam], clockwise from the bow, rising (may exceed 360)
  double mounting_azimuth_deg = 270.0;       ///< where azimuth 0 of the file looks, clockwise from the bow
  std::vector<double> frequency_hz;          ///< [fan]
  std::vector<int> channel;                  ///< [fan][beam] -> 0-based channel
  std::vector<double> vertical_width_deg;    ///< [fan][beam], one-way -3 dB, steering included
  std::vector<double> horizontal_width_deg;  ///< [fan][beam]
  std::vector<double> psi_stated_db;  ///< [fan][beam], equivalent two-way beam angle, dB re 1 sr; empty = not told

  [[nodiscard]] int fans() const { return static_cast<int>(elevation_deg.size()); }
  [[nodiscard]] int beams() const { return static_cast<int>(azimuth_deg.size()); }
  /// Row (fan * beams + beam) of each channel; -1 = none.
  [[nodiscard]] std::vector<int> row_of_channel() const;
  [[nodiscard]] Sector sector(const RangeAxis& range) const;
  friend bool operator==(const BeamGrid&, const BeamGrid&) = default;
};

/// Derives the grid from the beams' directions: clusters of elevation, then equal sets of azimuth in each.
/// mounting_azimuth_deg  270 = port, 90 = starboard
/// tolerance_deg         directions closer than this are one
/// errors                unsupported, with a sentence, where the beams make no product grid
[[nodiscard]] Result<BeamGrid> derive_beam_grid(const SounderConfig& config, double mounting_azimuth_deg,
                                                double tolerance_deg = 0.05);

}  // namespace sonar
