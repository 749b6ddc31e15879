// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/array.h"
#include "base/units.h"
#include "model/water_levels.h"

namespace sonar {

/// By which every median of Rayleigh-fading echo lies below its mean, whatever the sonar: 10 log10(ln 2). Thresholds are
/// meant for the mean.
inline constexpr double kMedianOfMean_db = -1.5917;

/// Noise of a ping: a level for each beam with the table that turns power into Sv; borrowed.
struct Background {
  std::span<const double> power_db;       ///< [row] mean (not median) power, dB re 1 W; NaN or empty = none known
  View3<const std::int16_t> calibration;  ///< [fan][beam][sample]: Sv counts = power counts + this; kNoData = none

  [[nodiscard]] bool known(int row) const {
    return static_cast<std::size_t>(row) < power_db.size() && calibration.data() != nullptr &&
           std::isfinite(power_db[static_cast<std::size_t>(row)]);
  }
  /// Mean power of a known row, counts re 1 W.
  [[nodiscard]] double power_counts(int row) const { return counts_from_db(power_db[static_cast<std::size_t>(row)]); }
};

/// Expected linear sv of the background along one beam, m^-1; 0 where it is not known.
class RowBackground {
 public:
  RowBackground(const Background& background, int row) {
    if (!background.known(row)) return;
    power_ = linear_from_db(background.power_db[static_cast<std::size_t>(row)]);
    calibration_ = background.calibration.row(row);
  }
  [[nodiscard]] double operator()(int sample) const {
    return calibration_.empty() ? 0.0 : power_ * linear_from_count(calibration_[static_cast<std::size_t>(sample)]);
  }

 private:
  double power_ = 0.0;
  std::span<const std::int16_t> calibration_;
};

}  // namespace sonar
