// SPDX-License-Identifier: Apache-2.0
#include "school/integrate/integrate_ping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/check.h"
#include "base/units.h"
#include "school/fading.h"
#include "school/integrate/depth_parts.h"
#include "school/measure/echo_statistics.h"
#include "school/measure/extinction.h"
#include "school/measure/measure_input.h"

namespace sonar {
namespace {

double farthest_m(const RangeAxis& range, const CellLayout& layout) {
  return std::min(range.range_m(range.count - 1), layout.max_range_m);
}

int channels_of(const DepthAlong& along, double reach_m, const CellLayout& layout, std::span<const BeamSlope> slopes) {
  double deepest = 0.0;
  for (std::size_t row = 0; row < slopes.size(); ++row) {
    if (row > 0 && slopes[row] == slopes[row - 1]) continue;
    deepest = std::max(deepest, along.deepest_m(slopes[row], reach_m));
  }
  const double channels = std::floor((deepest - layout.depth_from_m) / layout.channel_m) + 1.0;
  return static_cast<int>(std::clamp(channels, 0.0, static_cast<double>(layout.max_channels)));
}

/// Where the first beam's near field ends.
int first_beyond_near_field(View3<const SampleFlags> flags, int rows) {
  int first = flags.shape().samples;
  for (int row = 0; row < rows; ++row) {
    const auto of_row = flags.row(row);
    const auto end = std::find_if(of_row.begin(), of_row.begin() + first,
                                  [](SampleFlags f) { return !any(f & SampleFlags::near_field); });
    first = static_cast<int>(end - of_row.begin());
  }
  return first;
}

/// Between depths a ring of the sector has the volume of this area times the height, at whatever depth: what a slant range
/// loses inside for being deeper it gains outside.
void add_areas(const Sector& sector, const CellLayout& layout, int first, std::vector<double>& area_m2) {
  const RangeAxis& range = sector.range();
  const double breadth = sector.azimuth_bounds(sector.beams() - 1).upper - sector.azimuth_bounds(0).lower;
  const double reach = farthest_m(range, layout);
  area_m2.assign(reach > 0.0 ? static_cast<std::size_t>(reach / layout.range_bin_m) + 1 : 0, 0.0);
  for (int sample = first; sample < range.count; ++sample) {
    const double r = range.range_m(sample);
    if (r < range.spacing_m || r >= layout.max_range_m) continue;
    area_m2[static_cast<std::size_t>(r / layout.range_bin_m)] += breadth * r * range.spacing_m;
  }
}

/// Runs of all schools by row.
std::vector<std::vector<Run>> runs_by_row(std::span<const PingMask* const> schools, int rows) {
  std::vector<std::vector<Run>> of_row(static_cast<std::size_t>(rows));
  for (const PingMask* mask : schools) {
    for (const Run& run : mask->runs) of_row[static_cast<std::size_t>(run.row)].push_back(run);
  }
  return of_row;
}

void mark_members(std::span<const Run> runs, std::vector<char>& member) {
  std::fill(member.begin(), member.end(), char{0});
  for (const Run& run : runs) std::fill_n(member.begin() + run.first_sample, run.count, char{1});
}

/// One voxel as the cells take it.
struct Voxel {
  double volume_m3 = 0.0;
  double sv = 0.0;     ///< as recorded, background included
  double noise = 0.0;  ///< the expected background
  double alike = 1.0;
  double inside = 1.0;  ///< share of it that lies in any channel
  // What it would be without extinction, over what is heard: at the ratio and at the ends of its interval.
  double gain = 1.0;
  double gain_low = 1.0;
  double gain_high = 1.0;
  bool heard = false;
  bool member = false;
};

/// Gains of a ping's beams; empty where nothing is corrected.
struct Gains {
  PingGain at_ratio;
  PingGain low;
  PingGain high;
};

Gains gains_of(const IntegrationInput& ping) {
  if (!ping.extinction.correct || ping.schools.empty()) return {};
  MeasureInput heard;
  heard.sv = ping.sv;
  heard.filtered = ping.filtered;
  heard.flags = ping.flags;
  heard.sector = ping.sector;
  heard.background = ping.background;
  const auto at = [&](double ratio) { return ping_gain(heard, ping.schools, ratio, ping.extinction.most_db); };
  return {at(ping.extinction.ratio), at(ping.extinction.ratio_low), at(ping.extinction.ratio_high)};
}

double gain_at(const PingGain& gain, std::size_t row, std::size_t sample) {
  return row < gain.size() && !gain[row].within.empty() ? gain[row].within[sample] : 1.0;
}

/// Exponential echo of mean m has the variance m^2, and 2 m^2 as mean square.
void add_part(const Voxel& voxel, const VoxelPart& part, CellSums& cell) {
  const double volume = voxel.volume_m3 * part.share;
  cell.water_m3 += volume;
  if (!voxel.heard) return;
  const double heard = (voxel.sv - voxel.noise) * volume;
  const double sv = voxel.gain * voxel.sv;
  const double noise = voxel.gain * voxel.noise;
  const double echo = (sv - noise) * volume;
  const double variance = 0.5 * voxel.alike * sv * sv * volume * volume;
  const double whole = variance / part.share * voxel.inside;
  cell.heard_m3 += volume;
  cell.echo_m2 += echo;
  cell.noise_m2 += noise * volume;
  cell.beam_m3 += volume * part.beam;
  cell.variance_m4 += variance;
  cell.whole_m4 += whole;
  cell.noise_m4 += voxel.alike * noise * noise * volume * volume;
  cell.extinction_m2 += (voxel.gain - 1.0) * heard;
  cell.extinction_low_m2 += (voxel.gain_low - 1.0) * heard;
  cell.extinction_high_m2 += (voxel.gain_high - 1.0) * heard;
  if (!voxel.member) return;
  cell.school_m3 += volume;
  cell.school_m2 += echo;
  cell.school_m4 += variance;
  cell.whole_school_m4 += whole;
}

}  // namespace

CellSums& CellSums::operator+=(const CellSums& other) {
  water_m3 += other.water_m3;
  heard_m3 += other.heard_m3;
  school_m3 += other.school_m3;
  echo_m2 += other.echo_m2;
  school_m2 += other.school_m2;
  noise_m2 += other.noise_m2;
  beam_m3 += other.beam_m3;
  variance_m4 += other.variance_m4;
  whole_m4 += other.whole_m4;
  school_m4 += other.school_m4;
  whole_school_m4 += other.whole_school_m4;
  noise_m4 += other.noise_m4;
  extinction_m2 += other.extinction_m2;
  extinction_low_m2 += other.extinction_low_m2;
  extinction_high_m2 += other.extinction_high_m2;
  return *this;
}

PingCells integrate_ping(const IntegrationInput& ping, const CellLayout& layout) {
  SONAR_CHECK(ping.sector != nullptr && ping.grid != nullptr);
  const Sector& sector = *ping.sector;
  const int rows = sector.fans() * sector.beams();
  const int samples = sector.range().count;
  std::vector<BeamSlope> slopes;
  for (int row = 0; row < rows; ++row) slopes.push_back(beam_slope(sector, *ping.grid, ping.placement, row));
  PingCells out;
  const DepthAlong along(ping.placement);
  out.channels = channels_of(along, farthest_m(sector.range(), layout), layout, slopes);
  add_areas(sector, layout, first_beyond_near_field(ping.flags, rows), out.area_m2);
  out.cells.resize(out.area_m2.size() * static_cast<std::size_t>(out.channels));
  const auto runs = runs_by_row(ping.schools, rows);
  std::vector<char> member(static_cast<std::size_t>(samples));
  const Gains gains = gains_of(ping);
  std::optional<DepthParts> parts;  // of the row before, which stabilised beams of a fan share
  for (int row = 0; row < rows; ++row) {
    const auto at = static_cast<std::size_t>(row);
    if (!parts || slopes[at] != slopes[at - 1]) {
      parts.emplace(slopes[at], along, sector.range(), layout, out.channels);
    }
    mark_members(runs[at], member);
    const auto counts = ping.sv.row(row);
    const auto flags = ping.flags.row(row);
    const RowBackground noise(ping.background, row);
    const double solid_angle = sector.solid_angle_sr(row / sector.beams(), row % sector.beams());
    const int seabed = seabed_heard(ping.seabed, row, samples);
    Voxel voxel;
    voxel.alike = voxels_alike(*ping.grid, sector.range().spacing_m, ping.pulse_m, row);
    for (int sample = 0; sample < samples; ++sample) {
      const auto s = static_cast<std::size_t>(sample);
      const auto of_voxel = parts->of(sample);
      voxel.member = member[s] != 0;
      if (of_voxel.empty() || any(flags[s] & kNeverMember) || (sample >= seabed && !voxel.member)) continue;
      voxel.volume_m3 = solid_angle * sector.shell_m3_per_sr(sample);
      voxel.heard = !is_faulty(flags[s], counts[s]);
      if (voxel.heard) {
        voxel.sv = linear_from_count(counts[s]);
        voxel.noise = noise(sample);
        voxel.gain = gain_at(gains.at_ratio, at, s);
        voxel.gain_low = gain_at(gains.low, at, s);
        voxel.gain_high = gain_at(gains.high, at, s);
      }
      voxel.inside = 0.0;
      for (const VoxelPart& part : of_voxel) voxel.inside += part.share;
      for (const VoxelPart& part : of_voxel) add_part(voxel, part, out.cells[static_cast<std::size_t>(part.cell)]);
    }
  }
  return out;
}

}  // namespace sonar
