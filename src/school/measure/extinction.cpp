// SPDX-License-Identifier: Apache-2.0
#include "school/measure/extinction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/units.h"
#include "school/measure/echo_row.h"

namespace sonar {
namespace {

/// Mean of 1 / (1 - x) while x goes from one value to another: what a sample's echo has to be multiplied by.
double mean_gain(double from, double to) {
  constexpr double kAlike = 1e-6;
  if (std::abs(to - from) < kAlike) return 1.0 / (1.0 - 0.5 * (from + to));
  return std::log((1.0 - from) / (1.0 - to)) / (to - from);
}

}  // namespace

BeamGain beam_gain(std::span<const double> observed, double spacing_m, double ratio, double most_db) {
  const double per_sv = 2.0 * 4.0 * std::numbers::pi * ratio * spacing_m;
  const double most = 1.0 - linear_from_db(-most_db);
  BeamGain out;
  out.within.reserve(observed.size());
  out.behind.reserve(observed.size());
  double x = 0.0;
  for (const double sv : observed) {
    const double next = std::max(0.0, x + per_sv * sv);  // what the background leaves may be negative
    out.capped = out.capped || next > most;
    const double end = std::min(next, most);
    out.within.push_back(mean_gain(x, end));
    out.behind.push_back(1.0 / (1.0 - end));
    x = end;
  }
  return out;
}

PingGain ping_gain(const MeasureInput& ping, std::span<const PingMask* const> masks, double ratio, double most_db) {
  const auto samples = static_cast<std::size_t>(ping.sv.shape().samples);
  std::vector<std::vector<double>> observed(ping.sv.shape().rows());
  for (const PingMask* mask : masks) {
    for (const Run& run : mask->runs) {
      std::vector<double>& of_row = observed[static_cast<std::size_t>(run.row)];
      of_row.resize(samples, 0.0);
      const EchoRow echo(ping, run.row, 1.0);
      for (int s = run.first_sample; s < run.end(); ++s) {
        double sv = 0.0;
        double behind = 0.0;
        if (echo.at(s, sv, behind)) of_row[static_cast<std::size_t>(s)] = sv - behind;
      }
    }
  }
  PingGain out(observed.size());
  for (std::size_t row = 0; row < observed.size(); ++row) {
    if (observed[row].empty()) continue;
    out[row] = beam_gain(observed[row], ping.sector->range().spacing_m, ratio, most_db);
  }
  return out;
}

Array3<std::int16_t> without_extinction(View3<const std::int16_t> sv, const Background& background,
                                        const PingGain& gain, double of_mean) {
  Array3<std::int16_t> out(sv.shape());
  std::copy(sv.all().begin(), sv.all().end(), out.all().begin());
  for (std::size_t row = 0; row < gain.size(); ++row) {
    const auto counts = out.view().row(static_cast<int>(row));
    const RowBackground noise(background, static_cast<int>(row));
    for (std::size_t s = 0; s < gain[row].within.size(); ++s) {
      if (counts[s] == kNoData) continue;
      const double behind = of_mean * noise(static_cast<int>(s));
      const double echo = behind + gain[row].within[s] * (linear_from_count(counts[s]) - behind);
      counts[s] = echo > 0.0 ? count_from_linear(echo) : kMinCount;
    }
  }
  return out;
}

PingShadow::PingShadow(const MeasureInput& ping, std::span<const PingMask* const> masks, const ExtinctionParams& params)
    : ping_(ping),
      gain_(ping_gain(ping, masks, params.ratio, params.most_db)),
      low_(ping_gain(ping, masks, params.ratio_low, params.most_db)),
      high_(ping_gain(ping, masks, params.ratio_high, params.most_db)),
      corrected_(params.correct) {}

double PingShadow::lost_share(const PingMask& mask, const PingGain& gain) const {
  double heard = 0.0;
  double whole = 0.0;
  for (const Run& run : mask.runs) {
    const EchoRow echo(ping_, run.row, 1.0);
    const BeamGain& beam = gain[static_cast<std::size_t>(run.row)];
    const int beams = ping_.sector->beams();
    const double solid_angle = ping_.sector->solid_angle_sr(run.row / beams, run.row % beams);
    for (int s = run.first_sample; s < run.end(); ++s) {
      double sv = 0.0;
      double behind = 0.0;
      if (!echo.at(s, sv, behind)) continue;
      const double of_voxel = (sv - behind) * solid_angle * ping_.sector->shell_m3_per_sr(s);
      heard += of_voxel;
      whole += of_voxel * beam.within[static_cast<std::size_t>(s)];
    }
  }
  return heard > 0.0 && whole >= heard ? 1.0 - heard / whole : kUnknown;
}

void PingShadow::tell(const PingMask& mask, SchoolPingRow& row) const {
  double most = 1.0;
  for (const Run& run : mask.runs) {
    const BeamGain& beam = gain_[static_cast<std::size_t>(run.row)];
    for (int s = run.first_sample; s < run.end(); ++s) most = std::max(most, beam.behind[static_cast<std::size_t>(s)]);
  }
  row.extinction_loss_db = db_from_linear(most);
  row.extinction_share = lost_share(mask, gain_);
  row.extinction_share_low = lost_share(mask, low_);
  row.extinction_share_high = lost_share(mask, high_);
  row.extinction_corrected = corrected_ ? 1.0 : 0.0;
}

}  // namespace sonar
