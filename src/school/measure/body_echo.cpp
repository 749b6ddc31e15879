// SPDX-License-Identifier: Apache-2.0
#include "school/measure/body_echo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "base/units.h"
#include "school/measure/echo_row.h"
#include "school/measure/two_way_beam.h"
#include "school/runs.h"

namespace sonar {
namespace {

/// Standard deviation of a two-way Gaussian beam from its one-way -3 dB width.
double two_way_sigma_rad(double width_deg) { return rad_from_deg(width_deg) / (4.0 * std::sqrt(std::numbers::ln2)); }

PingMask with_confidence(std::vector<Run> runs) {
  PingMask mask;
  std::size_t voxels = 0;
  for (const Run& run : runs) voxels += static_cast<std::size_t>(run.count);
  mask.runs = std::move(runs);
  mask.confidence.assign(voxels, 1);
  return mask;
}

/// A mask and the beams next to it: a loud school's echo there may be louder than a faint neighbour's own.
PingMask with_beam_edges(const PingMask& mask, const Shape3& shape) {
  std::vector<Run> all = mask.runs;
  for (const Run& run : mask.runs) {
    const NeighbourRows rows = neighbour_rows(run.row, shape, Connectivity::faces);
    for (int n = 0; n < rows.count; ++n) all.push_back({rows.row[n], run.first_sample, run.count});
  }
  std::sort(all.begin(), all.end());
  return with_confidence(merged_runs(all));
}

/// Leaves out the beam-edge seabed echo, but for members.
void leave_seabed(const MeasureInput& ping, const PingMask& mask, std::vector<Run>& runs) {
  PingMask heard;
  for (const Run& run : runs) {
    const int first = std::max(run.first_sample, ping.seabed_heard(run.row));
    if (first < run.end()) heard.runs.push_back({run.row, first, run.end() - first});
  }
  if (heard.runs.empty()) return;
  const PingMask foreign = subtract(with_confidence(std::move(heard.runs)), mask);
  runs = subtract(with_confidence(std::move(runs)), foreign).runs;
}

/// The water that holds the school's echo, without what belongs to others and to their beam edges: the mask widened in beams
/// and samples, and that through all fans of the mask and some more. Where the echo is weak the mask is thin, but the
/// beam is not.
std::vector<Run> surroundings(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params) {
  const Shape3 shape = ping.sv.shape();
  const IndexBox box = box_of(mask, shape.beams);
  std::vector<Run> columns;  // row = beam
  for (const Run& run : mask.runs) {
    const int beam = run.row % shape.beams;
    const int first = std::max(0, run.first_sample - params.reach_samples);
    const int end = std::min(shape.samples, run.end() + params.reach_samples);
    for (int b = std::max(0, beam - params.reach_beams); b <= std::min(shape.beams - 1, beam + params.reach_beams);
         ++b) {
      columns.push_back({b, first, end - first});
    }
  }
  std::sort(columns.begin(), columns.end());
  const std::vector<Run> wide = merged_runs(columns);
  PingMask united;
  const int first_fan = std::max(0, box.first_fan - params.reach_fans);
  const int last_fan = std::min(shape.fans - 1, box.last_fan + params.reach_fans);
  for (int fan = first_fan; fan <= last_fan; ++fan) {
    for (const Run& run : wide) united.runs.push_back({fan * shape.beams + run.row, run.first_sample, run.count});
  }
  leave_seabed(ping, mask, united.runs);
  if (ping.others == nullptr || ping.others->empty()) return std::move(united.runs);
  return subtract(with_confidence(std::move(united.runs)), subtract(with_beam_edges(*ping.others, shape), mask)).runs;
}

/// [beam x samples + sample] Where other schools' echo is no background, in any fan: the beam's skirts are high.
std::vector<bool> heard_of_others(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params) {
  const Shape3 shape = ping.sv.shape();
  std::vector<bool> loud(static_cast<std::size_t>(shape.beams) * static_cast<std::size_t>(shape.samples), false);
  if (ping.others == nullptr) return loud;
  for (const Run& run : subtract(*ping.others, mask).runs) {
    const int beam = run.row % shape.beams;
    const int first = std::max(0, run.first_sample - params.reach_samples);
    const int end = std::min(shape.samples, run.end() + params.reach_samples);
    const int first_beam = std::max(0, beam - params.others_beams);
    const int last_beam = std::min(shape.beams - 1, beam + params.others_beams);
    for (int b = first_beam; b <= last_beam; ++b) {
      const auto row = loud.begin() + static_cast<std::ptrdiff_t>(b) * shape.samples;
      std::fill(row + first, row + end, true);
    }
  }
  return loud;
}

/// What the background near the school is, as a multiple of the expected: its reverberation changes with range as no
/// beam's average does, and in the far skirts of the beam a tenth too much looks like a lower school.
/// out  [fan], from the median over the samples just before and behind the stretch
std::vector<double> background_factors(const MeasureInput& ping, const std::vector<Run>& runs,
                                       const std::vector<bool>& loud, const MeasureParams& params) {
  const Shape3 shape = ping.sv.shape();
  std::vector<std::vector<double>> offsets(static_cast<std::size_t>(shape.fans));
  const auto collect = [&](int row, int first, int end) {
    if (!ping.background.known(row)) return;
    const auto counts = ping.sv.row(row);
    const auto flags = ping.flags.row(row);
    const auto calibration = ping.background.calibration.row(row);
    const double power = ping.background.power_counts(row);
    const auto is_loud = loud.begin() + static_cast<std::ptrdiff_t>(row % shape.beams) * shape.samples;
    for (int s = std::max(first, 0); s < std::min(end, ping.seabed_heard(row)); ++s) {
      const auto i = static_cast<std::size_t>(s);
      if (is_loud[s] || any(flags[i] & kNotFiltered) || counts[i] == kNoData || calibration[i] == kNoData) continue;
      offsets[static_cast<std::size_t>(row / shape.beams)].push_back(counts[i] - calibration[i] - power);
    }
  };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    const int row = run.row;
    if (i == 0 || runs[i - 1].row != row) {
      const int end = run.first_sample - params.ring_gap_samples;
      collect(row, end - params.ring_samples, end);
    }
    if (i + 1 == runs.size() || runs[i + 1].row != row) {
      const int first = run.end() + params.ring_gap_samples;
      collect(row, first, first + params.ring_samples);
    }
  }
  std::vector<double> factors(offsets.size(), 1.0);
  for (std::size_t fan = 0; fan < offsets.size(); ++fan) {
    std::vector<double>& values = offsets[fan];
    if (values.size() < static_cast<std::size_t>(params.min_ring_samples)) continue;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    const double factor = linear_from_db(db_from_counts(*middle)) / std::numbers::ln2;
    factors[fan] = std::clamp(factor, 1.0 / params.max_ring_factor, params.max_ring_factor);
  }
  return factors;
}

struct Moments {
  double weight = 0.0;
  Vector3 first{};
  Covariance3 second{};
  Covariance3 blur{};
  Covariance3 upright{};
  Covariance3 sideways{};
  double range2 = 0.0;  ///< sum of weight x range^2
  LevelMoments level;
};

/// One fan's echo, summed with the volume of a steradian's shells.
struct FanSum {
  double echo = 0.0;
  double background = 0.0;
  double shells = 0.0;
  double whole = 0.0;  ///< as shells, invalid samples included
  double heard = 0.0;  ///< as shells, without what the filtered volume stands in for
  double sigma = 0.0;
  int samples = 0;
};

void add_row(Moments& m, FanSum& sum, const MeasureInput& ping, const Run& run, double background_factor) {
  const Sector& sector = *ping.sector;
  const int fan = run.row / sector.beams();
  const int beam = run.row % sector.beams();
  const EchoRow echo(ping, run.row, background_factor);
  const double solid_angle = sector.solid_angle_sr(fan, beam);
  std::array<double, 5> of_range{};  ///< sums of weight x range^k
  for (int s = run.first_sample; s < run.end(); ++s) {
    double sv = 0.0;
    double background = 0.0;
    const double shell = sector.shell_m3_per_sr(s);
    sum.whole += shell;
    if (!echo.at(s, sv, background)) continue;
    sum.echo += shell * sv;
    sum.background += shell * background;
    sum.shells += shell;
    if (echo.heard(s)) sum.heard += shell;
    ++sum.samples;
    const double range = sector.range().range_m(s);
    double weight = (sv - background) * shell * solid_angle;
    for (double& of_power : of_range) {
      of_power += weight;
      weight *= range;
    }
  }
  const double w0 = of_range[0];
  const double w1 = of_range[1];
  const double w2 = of_range[2];
  const double e = sector.elevation_rad(fan);
  const double a = sector.azimuth_rad(beam);
  const Vector3 along{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), -std::sin(e)};
  const Vector3 up{-std::sin(e) * std::cos(a), -std::sin(e) * std::sin(a), -std::cos(e)};
  const Vector3 sideways{-std::sin(a), std::cos(a), 0.0};
  m.weight += w0;
  m.level.add(a, of_range);
  for (std::size_t k = 0; k < 3; ++k) m.first[k] += w1 * along[k];
  add_square(m.second, along, w2);
  const auto r = static_cast<std::size_t>(run.row);
  const double sigma_v = two_way_sigma_rad(ping.grid->vertical_width_deg[r]);
  const double sigma_h = two_way_sigma_rad(ping.grid->horizontal_width_deg[r]);
  m.range2 += w2;
  sum.sigma = sigma_v;
  add_square(m.blur, up, w2 * sigma_v * sigma_v);
  add_square(m.blur, sideways, w2 * sigma_h * sigma_h);
  add_square(m.upright, up, w2 * sigma_v * sigma_v);
  add_square(m.sideways, sideways, w2 * sigma_h * sigma_h);
  add_square(m.blur, along, w0 * ping.pulse_m * ping.pulse_m / 12.0);
}

/// Fans of which enough of the stretch was heard: what stands in for a fan that is missing is its neighbours' echo.
std::vector<FanEcho> profile(const std::vector<FanSum>& sums, const Sector& sector, double least_share) {
  std::vector<FanEcho> fans;
  for (std::size_t fan = 0; fan < sums.size(); ++fan) {
    const FanSum& sum = sums[fan];
    if (!(sum.echo > 0.0) || sum.heard < least_share * sum.whole) continue;
    fans.push_back({sector.elevation_rad(static_cast<int>(fan)), sum.sigma, sum.echo / sum.shells,
                    sum.background / sum.shells, static_cast<double>(sum.samples)});
  }
  return fans;
}

}  // namespace

BodyEcho body_echo(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params) {
  Moments m;
  std::vector<FanSum> sums(static_cast<std::size_t>(ping.sector->fans()));
  const std::vector<Run> stretch = surroundings(ping, mask, params);
  const std::vector<double> factors = background_factors(ping, stretch, heard_of_others(ping, mask, params), params);
  for (const Run& run : stretch) {
    const auto fan = static_cast<std::size_t>(run.row / ping.sector->beams());
    add_row(m, sums[fan], ping, run, factors[fan]);
  }
  BodyEcho out;
  if (!(m.weight > 0.0)) return out;
  const Vector3 centre{m.first[0] / m.weight, m.first[1] / m.weight, m.first[2] / m.weight};
  for (std::size_t a = 0, k = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b, ++k) {
      out.total[k] = m.second[k] / m.weight - centre[a] * centre[b];
      out.blur[k] = m.blur[k] / m.weight;
      out.upright[k] = m.upright[k] / m.weight;
      out.sideways[k] = m.sideways[k] / m.weight;
    }
  }
  out.centre = {centre[0], centre[1], centre[2]};
  out.mean_range2_m2 = m.range2 / m.weight;
  out.two_way_area = ping.two_way_area;
  out.known = true;
  out.level = m.level;
  const double spacing_m = ping.sector->range().spacing_m;
  out.looks = static_cast<double>(mask.voxels()) * spacing_m / std::max(spacing_m, ping.pulse_m);
  const std::vector<FanEcho> fans = profile(sums, *ping.sector, params.min_fan_share);
  for (const BeamShape& shape : beam_shapes(params, ping.two_way_area)) {
    const BeamModel beam{shape.gaussian_share, params.beam_pedestal, shape.transmit_ratio};
    out.heights.push_back(height_likelihood(fans, beam, std::sqrt(out.mean_range2_m2)));
  }
  return out;
}

}  // namespace sonar
