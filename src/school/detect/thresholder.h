// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "model/mask.h"
#include "school/detect/noise_level.h"
#include "school/runs.h"

namespace sonar {

/// Thresholds a ping's filtered Sv row by row, with the background of each voxel taken into account: its beam's noise or
/// the water at that place, whichever is louder. The filtered background lies ln 2 below its mean, as every median of
/// Rayleigh-fading echo does.
class Thresholder {
 public:
  /// sv          [fan][beam][sample], median-filtered Sv counts
  /// flags       same shape; kNeverMember samples are never in a run
  /// background  of the beams; rows without one are held against the water alone
  /// water       what else is background; null = nothing
  /// taken       voxels that are in no run; null = none
  /// All are borrowed.
  Thresholder(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const Background& background,
              const WaterLevels* water, const PingMask* taken = nullptr);

  /// Runs of the whole ping whose median lies margin_db above the background's, sorted. margin_db > 0
  /// cost  about 1 ms for 25 x 20 x 1320
  [[nodiscard]] std::vector<Run> above_background(double margin_db) const;

  /// Runs inside a box where the echo without its background reaches level_db, and the whole lies above the
  /// background by least_db or more, and by more than the water itself does.
  [[nodiscard]] std::vector<Run> above(const IndexBox& box, double level_db, double least_db) const;

  /// Mean background of a row at its samples first, first + step, ..., m^-1; 0 = none known.
  void background(int row, int first, int step, std::span<double> sv) const;

 private:
  /// What counts as background at a sample of one row, counts.
  class RowWater {
   public:
    RowWater(const Background& background, const WaterLevels* water, int row, int beams);
    /// Mean; kMinCount = none known.
    [[nodiscard]] int mean(int sample) const;
    /// How far above that the water reaches by itself.
    [[nodiscard]] int reach(int sample) const;

   private:
    template <class Value>
    [[nodiscard]] static double between(const Value* table, int count, double at);
    [[nodiscard]] double at_place(const std::int16_t* table, int sample) const;

    const std::int16_t* calibration_ = nullptr;
    int power_ = 0;
    const WaterLevels* water_ = nullptr;
    const std::int16_t* level_ = nullptr;
    const std::int16_t* reach_ = nullptr;
    const std::int8_t* patch_ = nullptr;
    double places_ = 0.0;  ///< of a sample
    double blocks_ = 0.0;
  };

  void cut(int row, int first, int end, std::vector<Run>& runs) const;
  template <class Member>
  void collect(int row, int first, int end, const Member& member, std::vector<Run>& runs) const;

  View3<const std::int16_t> sv_;
  View3<const SampleFlags> flags_;
  const Background& background_;
  const WaterLevels* water_;
  const PingMask* taken_;
  std::vector<int> taken_rows_;
  std::vector<int> ends_;  ///< [fan], recorded_ends()
};

}  // namespace sonar
