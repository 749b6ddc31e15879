// SPDX-License-Identifier: Apache-2.0
#include "model/beam_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "base/units.h"

namespace sonar {
namespace {

/// Sorted centres of groups of values that lie within the tolerance of the group's first.
std::vector<double> cluster(std::vector<double> values, double tolerance) {
  std::sort(values.begin(), values.end());
  std::vector<double> centres;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= values.size(); ++i) {
    if (i < values.size() && values[i] - values[first] <= tolerance) continue;
    centres.push_back(std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(first),
                                      values.begin() + static_cast<std::ptrdiff_t>(i), 0.0) /
                      static_cast<double>(i - first));
    first = i;
  }
  return centres;
}

/// Azimuths within -180 .. 180 on one continuous arc: those of an arc that crosses +-180 degrees go on above 180, so that
/// the widest gap between neighbours lies outside the arc. A whole circle, whose widest gap is like the others, stays.
std::vector<double> unwrapped(std::vector<double> azimuths, double tolerance) {
  std::vector<double> sorted = azimuths;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> gaps;
  double widest = 0.0;
  double arc_begins = sorted.front();
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (gap > tolerance) gaps.push_back(gap);
    if (gap <= widest + tolerance) continue;
    widest = gap;
    arc_begins = sorted[i];
  }
  const double across_180 = 360.0 - (sorted.back() - sorted.front());
  if (gaps.empty() || widest <= across_180 + tolerance) return azimuths;
  std::sort(gaps.begin(), gaps.end());
  // With two directions there is no usual gap to compare with, and no circle either.
  if (gaps.size() > 1 && widest <= 1.5 * gaps[(gaps.size() - 1) / 2]) return azimuths;
  for (double& azimuth : azimuths) azimuth += azimuth < arc_begins ? 360.0 : 0.0;
  return azimuths;
}

std::size_t nearest(const std::vector<double>& centres, double value) {
  const auto after = std::lower_bound(centres.begin(), centres.end(), value);
  if (after == centres.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - centres.begin());
  if (after == centres.end()) return i - 1;
  return value - centres[i - 1] <= centres[i] - value ? i - 1 : i;
}

tl::unexpected<Error> no_grid(std::string why) {
  return fail(ErrorCode::unsupported, "the beams make no product grid: " + std::move(why));
}

/// from_abeam_deg      azimuth of each of the config's beams, unwrapped
/// azimuth_from_abeam  [beam] of the grid
Result<BeamGrid> fill(const SounderConfig& config, BeamGrid grid, const std::vector<double>& from_abeam_deg,
                      const std::vector<double>& azimuth_from_abeam) {
  const auto beams = azimuth_from_abeam.size();
  const auto cells = grid.elevation_deg.size() * beams;
  if (cells != config.beams.size()) {
    return no_grid(fmt::format("{} beams, but {} elevations x {} azimuths", config.beams.size(),
                               grid.elevation_deg.size(), beams));
  }
  grid.channel.assign(cells, -1);
  grid.vertical_width_deg.resize(cells);
  grid.horizontal_width_deg.resize(cells);
  grid.psi_stated_db.resize(cells);
  grid.frequency_hz.assign(grid.elevation_deg.size(), 0.0);
  for (std::size_t i = 0; i < config.beams.size(); ++i) {
    const BeamConfig& beam = config.beams[i];
    const std::size_t fan = nearest(grid.elevation_deg, beam.direction_deg[0]);
    const std::size_t row = fan * beams + nearest(azimuth_from_abeam, from_abeam_deg[i]);
    if (grid.channel[row] >= 0) {
      return no_grid(fmt::format("channels {} and {} share a direction", grid.channel[row], i));
    }
    grid.channel[row] = static_cast<int>(i);
    grid.vertical_width_deg[row] = beam.width_alongship_deg;
    grid.horizontal_width_deg[row] = beam.width_athwartship_deg;
    grid.psi_stated_db[row] = beam.equivalent_beam_angle_db;
    grid.frequency_hz[fan] += beam.frequency_hz / static_cast<double>(beams);
  }
  return grid;
}

}  // namespace

std::vector<int> BeamGrid::row_of_channel() const {
  // A sounder may have channels that are in no fan: numbers run on beyond the count of rows.
  std::size_t channels = channel.size();
  for (const int number : channel) channels = std::max(channels, static_cast<std::size_t>(number) + 1);
  std::vector<int> rows(channels, -1);
  for (std::size_t row = 0; row < channel.size(); ++row) {
    rows[static_cast<std::size_t>(channel[row])] = static_cast<int>(row);
  }
  return rows;
}

Sector BeamGrid::sector(const RangeAxis& range) const {
  const auto radians = [](const std::vector<double>& deg) {
    std::vector<double> rad(deg.size());
    std::transform(deg.begin(), deg.end(), rad.begin(), rad_from_deg);
    return rad;
  };
  return {radians(elevation_deg), radians(azimuth_deg), range,
          rad_from_deg(vertical_width_deg.empty() ? 0.0 : vertical_width_deg.front()),
          rad_from_deg(horizontal_width_deg.empty() ? 0.0 : horizontal_width_deg.front())};
}

Result<BeamGrid> derive_beam_grid(const SounderConfig& config, double mounting_azimuth_deg, double tolerance_deg) {
  if (config.beams.empty()) return no_grid("there are no beams");
  if (config.kind == SounderKind::ek60 || config.kind == SounderKind::me70 || config.kind == SounderKind::omni) {
    return no_grid(fmt::format("{} does not look sideways in fans", model_and_name(config)));
  }
  std::vector<double> elevations;
  std::vector<double> azimuths;
  for (const BeamConfig& beam : config.beams) {
    if (!std::isfinite(beam.direction_deg[0]) || !std::isfinite(beam.direction_deg[1]) ||
        std::abs(beam.direction_deg[0]) > 90.0 || std::abs(beam.direction_deg[1]) > 180.0) {
      return no_grid("a beam has no usable direction");
    }
    elevations.push_back(beam.direction_deg[0]);
    azimuths.push_back(beam.direction_deg[1]);
  }
  BeamGrid grid;
  grid.elevation_deg = cluster(std::move(elevations), tolerance_deg);
  azimuths = unwrapped(std::move(azimuths), tolerance_deg);
  const std::vector<double> from_abeam = cluster(azimuths, tolerance_deg);
  grid.mounting_azimuth_deg = mounting_azimuth_deg;
  for (const double azimuth : from_abeam) grid.azimuth_deg.push_back(mounting_azimuth_deg + azimuth);
  return fill(config, std::move(grid), azimuths, from_abeam);
}

}  // namespace sonar
