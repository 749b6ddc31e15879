// SPDX-License-Identifier: Apache-2.0
#include "synth/layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar::synth {
namespace {

RowBeam row_beam(const Beam& beam, int channel, double mounting_azimuth_deg) {
  const double two_way = 1.0 / (4.0 * std::sqrt(std::numbers::ln2));
  RowBeam row;
  row.channel = channel;
  row.count = beam.count;
  row.elevation_rad = rad_from_deg(beam.elevation_deg);
  row.azimuth_rad = rad_from_deg(mounting_azimuth_deg + beam.azimuth_deg);
  row.vertical_width_rad = rad_from_deg(beam.vertical_width_deg);
  row.sigma_v_rad = two_way * row.vertical_width_rad;
  row.sigma_h_rad = two_way * rad_from_deg(beam.horizontal_width_deg);
  return row;
}

void unwrap(RowBeam& beam, const BeamGrid& grid, std::size_t row) {
  const double turn = 2.0 * std::numbers::pi;
  const double azimuth = rad_from_deg(grid.azimuth_deg[row % grid.azimuth_deg.size()]);
  beam.azimuth_rad += turn * std::round((azimuth - beam.azimuth_rad) / turn);
}

void record_grid(Layout& layout, BeamGrid grid) {
  layout.shape.fans = grid.fans();
  layout.shape.beams = grid.beams();
  GridRecord record;
  for (int fan = 0; fan < grid.fans(); ++fan) {
    int count = 0;
    for (int beam = 0; beam < grid.beams(); ++beam) {
      const auto row = static_cast<std::size_t>(fan * grid.beams() + beam);
      count = std::max(count, layout.beams[static_cast<std::size_t>(grid.channel[row])].count);
    }
    record.sample_count.push_back(count);
  }
  record.grid = std::move(grid);
  record.range = layout.range;
  record.sound_speed_mps = kSoundSpeed_mps;
  layout.grid = std::move(record);
}

}  // namespace

double vertical_density(BeamPattern pattern, const RowBeam& row, double elevation_rad) {
  const double x = (elevation_rad - row.elevation_rad) / row.sigma_v_rad;
  constexpr PatternPart kPart = PatternPart::vertical;
  if (std::abs(x) > pattern_reach(pattern, kPart)) return 0.0;
  return pattern_value(pattern, kPart, x) / (pattern_integral(pattern, kPart) * row.sigma_v_rad);
}

std::vector<Beam> sounding_beams(std::vector<Beam> beams, BeamPattern pattern) {
  if (!has_own_beam_angle(pattern)) return beams;
  const double integral =
      pattern_integral(pattern, PatternPart::vertical) * pattern_integral(pattern, PatternPart::horizontal);
  for (Beam& beam : beams) {
    const RowBeam row = row_beam(beam, 0, 0.0);
    beam.psi_db = db_from_linear(integral * row.sigma_v_rad * row.sigma_h_rad);
  }
  return beams;
}

Layout make_layout(std::vector<Beam> beams, BeamPattern pattern) {
  Layout layout;
  layout.pattern = pattern;
  layout.beams = std::move(beams);
  int samples = 0;
  for (const Beam& beam : layout.beams) samples = std::max(samples, beam.count);
  layout.range = {-kSoundSpeed_mps * kPulseLength_s / 4.0, kSoundSpeed_mps * kSampleInterval_s / 2.0, samples};
  layout.shape = {1, static_cast<int>(layout.beams.size()), samples};
  auto grid = derive_beam_grid(sounder_config(layout.beams, ""), layout.mounting_azimuth_deg);
  if (grid) record_grid(layout, std::move(*grid));
  for (std::size_t row = 0; row < layout.beams.size(); ++row) {
    const int channel = layout.grid ? layout.grid->grid.channel[row] : static_cast<int>(row);
    layout.rows.push_back(
        row_beam(layout.beams[static_cast<std::size_t>(channel)], channel, layout.mounting_azimuth_deg));
    // An arc that crosses +-180 degrees goes on above, as the grid's azimuths do.
    if (layout.grid) unwrap(layout.rows.back(), layout.grid->grid, row);
    layout.max_sigma_v_rad = std::max(layout.max_sigma_v_rad, layout.rows.back().sigma_v_rad);
    layout.max_sigma_h_rad = std::max(layout.max_sigma_h_rad, layout.rows.back().sigma_h_rad);
  }
  return layout;
}

}  // namespace sonar::synth
