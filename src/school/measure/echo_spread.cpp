// SPDX-License-Identifier: Apache-2.0
#include "school/measure/echo_spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/units.h"
#include "school/measure/echo_statistics.h"

namespace sonar {
namespace {

constexpr double kLowShare = 0.05;
constexpr double kHighShare = 0.95;

struct Heard {
  double sv = 0.0;
  double volume_m3 = 0.0;
};

/// Sums for a mean of sv.
struct Mean {
  double echo_m2 = 0.0;
  double volume_m3 = 0.0;
  void add(const Heard& one) {
    echo_m2 += one.sv * one.volume_m3;
    volume_m3 += one.volume_m3;
  }
  [[nodiscard]] double value() const { return volume_m3 > 0.0 ? echo_m2 / volume_m3 : kUnknown; }
};

/// Walks through sorted runs in step with a walk through a mask.
class Membership {
 public:
  explicit Membership(const std::vector<Run>& runs) : at_(runs.begin()), end_(runs.end()) {}
  [[nodiscard]] bool has(int row, int sample) {
    while (at_ != end_ && (at_->row < row || (at_->row == row && at_->end() <= sample))) ++at_;
    return at_ != end_ && at_->row == row && at_->first_sample <= sample;
  }

 private:
  std::vector<Run>::const_iterator at_;
  std::vector<Run>::const_iterator end_;
};

/// Mean of what lies between two shares of an exponential distribution, over the mean of all of it.
double exponential_share(double low, double high) {
  const double from = -std::log1p(-low);
  const double to = -std::log1p(-high);
  return ((1.0 + from) * (1.0 - low) - (1.0 + to) * (1.0 - high)) / (high - low);
}

double robust_mean(const std::vector<Heard>& all) {
  std::vector<double> values;
  values.reserve(all.size());
  for (const Heard& one : all) values.push_back(one.sv);
  const auto rank = [&](double share) {
    const double place = std::ceil(share * static_cast<double>(values.size())) - 1.0;
    return static_cast<std::ptrdiff_t>(std::max(place, 0.0));
  };
  const auto high = values.begin() + rank(kHighShare);
  std::nth_element(values.begin(), high, values.end());
  const double most = *high;
  const auto low = values.begin() + rank(kLowShare);
  if (low < high) std::nth_element(values.begin(), low, high);
  const double least = *low;
  Mean mean;
  for (const Heard& one : all) {
    if (one.sv >= least && one.sv <= most) mean.add(one);
  }
  return mean.value() / exponential_share(kLowShare, kHighShare);
}

void take_moments(const std::vector<Heard>& all, double mean, EchoSpread& out) {
  double volume = 0.0;
  double second = 0.0;
  double third = 0.0;
  double fourth = 0.0;
  for (const Heard& one : all) {
    const double off = one.sv / mean - 1.0;
    const double square = off * off * one.volume_m3;
    volume += one.volume_m3;
    second += square;
    third += square * off;
    fourth += square * off * off;
  }
  const double variance = second / volume;
  out.variation = std::sqrt(variance);
  if (!(variance > 0.0)) return;
  out.skewness = third / volume / (variance * out.variation);
  out.kurtosis = fourth / volume / (variance * variance) - 3.0;
}

}  // namespace

EchoSpread echo_spread(const MeasureInput& ping, const PingMask& mask, const std::vector<Run>& core) {
  const Sector& sector = *ping.sector;
  std::vector<Heard> all;
  all.reserve(mask.voxels());
  Mean whole;
  Mean of_core;
  Mean of_edge;
  Point<Sonar> first_moment;
  Membership in_core(core);
  for (const Run& run : mask.runs) {
    const auto counts = ping.sv.row(run.row);
    const auto flags = ping.flags.row(run.row);
    const RowBackground background(ping.background, run.row);
    const int fan = run.row / sector.beams();
    const int beam = run.row % sector.beams();
    const double solid_angle = sector.solid_angle_sr(fan, beam);
    double along = 0.0;
    for (int s = run.first_sample; s < run.end(); ++s) {
      const auto i = static_cast<std::size_t>(s);
      if (is_faulty(flags[i], counts[i])) continue;
      const Heard one{linear_from_count(counts[i]) - background(s), solid_angle * sector.shell_m3_per_sr(s)};
      all.push_back(one);
      whole.add(one);
      (in_core.has(run.row, s) ? of_core : of_edge).add(one);
      along += one.sv * one.volume_m3 * sector.range().range_m(s);
    }
    first_moment = first_moment + Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam)) * along;
  }
  EchoSpread out;
  const double mean = whole.value();
  if (!(mean > 0.0)) return out;
  const double robust = robust_mean(all);
  if (robust > 0.0) out.robust_mean_db = db_from_linear(robust);
  take_moments(all, mean, out);
  const double ratio = of_core.value() / of_edge.value();
  if (ratio > 0.0 && of_core.echo_m2 > 0.0) out.core_edge_db = db_from_linear(ratio);
  out.centre = first_moment * (1.0 / whole.echo_m2);
  return out;
}

}  // namespace sonar
