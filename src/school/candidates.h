// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "model/mask.h"
#include "school/background.h"
#include "school/runs.h"

namespace sonar {

/// Thresholds a ping's filtered Sv row by row, with the background of each beam taken into account.
class Thresholder {
 public:
  /// water  of the ping: water_levels()
  Thresholder(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& background,
              WaterLevels water, const PingMask* taken);

  /// Runs of the whole ping with Sv >= max(floor, background + margin), where the background is the beam's noise or the
  /// water at that range, whichever is louder. Noise that reaches higher than the margin counts as noise up to there.
  [[nodiscard]] std::vector<Run> candidates(double floor_db, double margin_db) const;

  /// Runs inside a box where the echo without its background reaches level_db, and the whole stands rest_db above the
  /// background. The filtered background lies ln 2 below its mean, as every median of Rayleigh-fading echo does.
  [[nodiscard]] std::vector<Run> above(const IndexBox& box, double level_db, double rest_db) const;

 private:
  void cut(int row, int first, int end, std::vector<Run>& runs) const;

  View3<const std::int16_t> sv_;
  View3<const SampleFlags> flags_;
  const Background& background_;
  WaterLevels water_;
  const PingMask* taken_;
  std::vector<int> taken_rows_;
  std::vector<int> ends_;  ///< [fan], recorded_ends()
};

}  // namespace sonar
