// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sonar {

/// What turns one channel's received power into volume backscattering strength; dB values as stored in the files.
struct ChannelCalibration {
  double frequency_hz = 0.0;
  double absorption_db_per_m = 0.0;  ///< one way
  double transmit_power_w = 0.0;
  double pulse_length_s = 0.0;  ///< nominal
  double sound_speed_mps = 0.0;
  double gain_db = 0.0;  ///< on the axis, counted twice
  double sa_correction_db = 0.0;
  double equivalent_beam_angle_db = 0.0;  ///< 10 log10 of psi in sr
  double extra_factor_db = 0.0;           ///< added to Sv: a user's own calibration
};

/// True where the sonar equation has a finite answer: all members finite, frequency, power, pulse and speed positive.
[[nodiscard]] bool is_sound(const ChannelCalibration& calibration);

/// The part of the sonar equation that does not depend on range, dB:
/// -10 log10(Pt lambda^2 c tau psi / (32 pi^2)) - 2 G - 2 Sa + extra factor.
[[nodiscard]] double sv_constant_db(const ChannelCalibration& calibration);

/// The same of the equation for a point target: -10 log10(Pt lambda^2 / (16 pi^2)) - 2 G.
/// Sp = P + 40 log10 r + 2 alpha r + this
[[nodiscard]] double sp_constant_db(const ChannelCalibration& calibration);

/// Where samples lie, which all channels of a grid share. first_range_m: range of sample 0, may be negative; ranges below one
/// spacing count as one spacing. All unknown where the spacing is not positive.
struct SampleRanges {
  SampleRanges(double first_range_m, double spacing_m, int count);
  std::vector<double> range_m;       ///< [sample]
  std::vector<double> spreading_db;  ///< 20 log10 r
};

/// What is added to power counts (10 log10(2)/256 dB re 1 W) to get Sv counts (same step, dB re 1 m^-1).
/// Sv = P + 20 log10 r + 2 alpha r - 10 log10(Pt lambda^2 c tau psi / (32 pi^2)) - 2 G - 2 Sa + extra factor
/// out     [sample], saturating; kNoData where the calibration is not sound or the range is not known
/// source  Simrad; ICES SONAR-netCDF4 convention, type 3
[[nodiscard]] std::vector<std::int16_t> sv_table(const ChannelCalibration& calibration, const SampleRanges& ranges);

/// Adds a table to a row of counts in place, saturating to kMinCount..kMaxCount; "no data" on either side stays so.
/// in      counts, table [sample]; samples beyond the table's end become kNoData
void apply_sv_table(std::span<std::int16_t> counts, std::span<const std::int16_t> table);

}  // namespace sonar
