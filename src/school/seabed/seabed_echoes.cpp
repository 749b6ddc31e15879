// SPDX-License-Identifier: Apache-2.0
#include "school/seabed/seabed_echoes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kBlock = 16;  ///< samples looked at together: for speed alone
constexpr SampleFlags kUnusable = SampleFlags::near_field | SampleFlags::surface;

class EchoFinder {
 public:
  explicit EchoFinder(const SeabedWater& water)
      : water_(water), sv_(water.sv), flags_(water.flags), sector_(water.sector), params_(water.params) {}

  std::vector<SeabedEcho> find() {
    for (int row = 0; row < static_cast<int>(sv_.shape().rows()); ++row) echoes_of(row);
    return std::move(echoes_);
  }

 private:
  void echoes_of(int row) {
    const auto counts = sv_.row(row);
    const auto flags = flags_.row(row);
    const LoudLimit limit = loud_limit(water_, row);
    const int least = std::max(1, static_cast<int>(params_.min_echo_m / sector_.range().spacing_m));
    const int samples = sv_.shape().samples;
    int start = -1;
    for (int s = 0; s <= samples; ++s) {
      if (start < 0 && s + kBlock <= samples && quiet(&counts[static_cast<std::size_t>(s)], limit.least)) {
        s += kBlock - 1;
        continue;
      }
      const auto i = static_cast<std::size_t>(s);
      const bool strong = s < samples && counts[i] >= limit(s) && !any(flags[i] & kUnusable);
      if (strong && start < 0) start = s;
      if (strong || start < 0) continue;
      if (s - start >= least) add_echo(row, start, s);
      start = -1;
    }
  }

  /// Most of a ping is: a fixed number of samples at a time is quickly looked through.
  static bool quiet(const std::int16_t* counts, int level) {
    int loud = 0;
    for (int j = 0; j < kBlock; ++j) loud |= counts[j] >= level ? 1 : 0;
    return loud == 0;
  }

  void add_echo(int row, int first, int end) {
    const auto counts = sv_.row(row);
    int at = first;
    for (int s = first; s < end; ++s) {
      if (counts[static_cast<std::size_t>(s)] > counts[static_cast<std::size_t>(at)]) at = s;
    }
    const int before =
        first - std::max(SeabedParams::before_samples, static_cast<int>(SeabedParams::before_share * (end - first)));
    // in the near field's crop stands the ringing, in the surface's the surface: nothing rises from there
    if (before < 0 || any(flags_.row(row)[static_cast<std::size_t>(before)] & kUnusable)) return;
    const std::int16_t peak = counts[static_cast<std::size_t>(at)];
    if (peak - counts[static_cast<std::size_t>(before)] < counts_from_db(params_.rise_db)) return;
    double weight = 0.0;
    double sum = 0.0;
    int last = at;
    for (int s = first; s < end; ++s) {
      if (counts[static_cast<std::size_t>(s)] < peak - counts_from_db(SeabedParams::near_peak_db)) continue;
      weight += 1.0;
      sum += sector_.range().range_m(s);
      last = s;
    }
    const double range_m = sum / weight;
    echoes_.push_back(
        {row, first, at, last >= first_cut_off(), db_from_counts(peak), range_m, beam_axis(sector_, row) * range_m});
  }

  [[nodiscard]] int first_cut_off() const {
    const int samples = sv_.shape().samples;
    return samples -
           std::max(SeabedParams::record_end_samples, static_cast<int>(SeabedParams::record_end_share * samples));
  }

  const SeabedWater& water_;
  View3<const std::int16_t> sv_;
  View3<const SampleFlags> flags_;
  const Sector& sector_;
  const SeabedParams& params_;
  std::vector<SeabedEcho> echoes_;
};

/// A cut echo may be a school's at the end of the beam, and its depth is but a bound. Where all of a fan shows echoes
/// there it is the seabed that begins, and the bound is all that the record tells; it is taken where nothing else is.
void drop_cut_echoes(const SeabedWater& water, std::vector<SeabedEcho>& echoes) {
  const auto whole = std::count_if(echoes.begin(), echoes.end(), [](const SeabedEcho& echo) { return !echo.cut; });
  if (whole >= water.params.min_inliers) {
    std::erase_if(echoes, [](const SeabedEcho& echo) { return echo.cut; });
    return;
  }
  std::vector<int> rows_with(static_cast<std::size_t>(water.sv.shape().fans), 0);
  int last_row = -1;
  for (const SeabedEcho& echo : echoes) {
    if (echo.row != last_row) ++rows_with[static_cast<std::size_t>(echo.row / water.sector.beams())];
    last_row = echo.row;
  }
  std::erase_if(echoes, [&](const SeabedEcho& echo) {
    const int with = rows_with[static_cast<std::size_t>(echo.row / water.sector.beams())];
    return echo.cut && with < SeabedParams::whole_fan_share * water.sector.beams();
  });
}

}  // namespace

LoudLimit loud_limit(const SeabedWater& water, int row) {
  const SeabedParams& params = water.params;
  LoudLimit limit{static_cast<int>(std::lround(counts_from_db(params.level_db))), 0, nullptr};
  if (!water.background.known(row)) return limit;
  const double above = water.background.power_counts(row) + counts_from_db(params.above_background_db);
  limit.above_table = static_cast<int>(std::lround(above));
  limit.table = water.background.calibration.row(row).data();
  return limit;
}

Point<Sonar> beam_axis(const Sector& sector, int row, double lower_by_rad) {
  const double elevation = sector.elevation_rad(row / sector.beams()) - lower_by_rad;
  return Sector::direction(std::max(elevation, -1.57), sector.azimuth_rad(row % sector.beams()));
}

std::vector<SeabedEcho> long_echoes(const SeabedWater& water) { return EchoFinder(water).find(); }

std::vector<SeabedEcho> seabed_echoes(const SeabedWater& water, std::vector<SeabedEcho> echoes) {
  // grazing beams see the seabed as a faint ramp, whose top is not on their axis
  std::erase_if(echoes,
                [&](const SeabedEcho& echo) { return beam_axis(water.sector, echo.row).z < SeabedParams::min_dip; });
  drop_cut_echoes(water, echoes);
  return echoes;
}

}  // namespace sonar
