// SPDX-License-Identifier: Apache-2.0
#include "signal/calibrate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/check.h"
#include "base/units.h"
#include "signal/row_kernels.h"

namespace sonar {

namespace {

bool positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

bool is_sound(const ChannelCalibration& c) {
  return positive(c.frequency_hz) && positive(c.transmit_power_w) && positive(c.pulse_length_s) &&
         positive(c.sound_speed_mps) && std::isfinite(c.absorption_db_per_m) && std::isfinite(sv_constant_db(c));
}

double sv_constant_db(const ChannelCalibration& c) {
  const double wavelength_m = c.sound_speed_mps / c.frequency_hz;
  const double psi_db = c.equivalent_beam_angle_db;
  const double constant = c.transmit_power_w * wavelength_m * wavelength_m * c.sound_speed_mps * c.pulse_length_s /
                          (32.0 * std::numbers::pi * std::numbers::pi);
  return -db_from_linear(constant) - psi_db - 2.0 * c.gain_db - 2.0 * c.sa_correction_db + c.extra_factor_db;
}

double sp_constant_db(const ChannelCalibration& c) {
  const double wavelength_m = c.sound_speed_mps / c.frequency_hz;
  const double constant =
      c.transmit_power_w * wavelength_m * wavelength_m / (16.0 * std::numbers::pi * std::numbers::pi);
  return -db_from_linear(constant) - 2.0 * c.gain_db;
}

SampleRanges::SampleRanges(double first_range_m, double spacing_m, int count) {
  SONAR_CHECK(count >= 0);
  const bool sound = positive(spacing_m) && std::isfinite(first_range_m);
  range_m.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    range_m.push_back(sound ? std::max(first_range_m + spacing_m * i, spacing_m)
                            : std::numeric_limits<double>::quiet_NaN());
  }
  for (const double range : range_m) spreading_db.push_back(20.0 * std::log10(range));
}

std::vector<std::int16_t> sv_table(const ChannelCalibration& calibration, const SampleRanges& ranges) {
  std::vector<std::int16_t> table(ranges.range_m.size(), kNoData);
  if (!is_sound(calibration)) return table;
  const double constant_db = sv_constant_db(calibration);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double tvg_db = ranges.spreading_db[i] + 2.0 * calibration.absorption_db_per_m * ranges.range_m[i];
    const double counts = std::clamp(counts_from_db(constant_db + tvg_db), -32767.0, 32767.0);
    if (std::isfinite(counts)) table[i] = static_cast<std::int16_t>(std::lround(counts));
  }
  return table;
}

void apply_sv_table(std::span<std::int16_t> counts, std::span<const std::int16_t> table) {
  const std::size_t common = std::min(counts.size(), table.size());
  add_saturating(counts.first(common), table.first(common));
  std::fill(counts.begin() + static_cast<std::ptrdiff_t>(common), counts.end(), kNoData);
}

}  // namespace sonar
