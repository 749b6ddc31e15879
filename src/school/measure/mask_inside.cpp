// SPDX-License-Identifier: Apache-2.0
#include "school/measure/mask_inside.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "school/runs.h"

namespace sonar {
namespace {

std::span<const Run> runs_of(const std::vector<Run>& runs, const std::vector<int>& first, int row) {
  const auto r = static_cast<std::size_t>(row);
  return std::span(runs).subspan(static_cast<std::size_t>(first[r]), static_cast<std::size_t>(first[r + 1] - first[r]));
}

/// The box of a mask with one more fan, beam and sample all round, in rows of its own: what is there is outside.
struct Surroundings {
  IndexBox box;
  Shape3 shape;

  explicit Surroundings(const IndexBox& of) : box(of), shape{of.fans() + 2, of.beams() + 2, of.samples() + 2} {}
  [[nodiscard]] bool at_border(int row) const {
    const int fan = row / shape.beams;
    const int beam = row % shape.beams;
    return fan == 0 || fan == shape.fans - 1 || beam == 0 || beam == shape.beams - 1;
  }
  /// Row of the sector; not at the border.
  [[nodiscard]] int sector_row(int row, int beams) const {
    return (row / shape.beams - 1 + box.first_fan) * beams + row % shape.beams - 1 + box.first_beam;
  }
};

/// What is no member in the box and round it, in its rows.
std::vector<Run> no_members(const std::vector<Run>& members, const std::vector<int>& first, const Surroundings& around,
                            int beams) {
  std::vector<Run> out;
  for (int row = 0; row < static_cast<int>(around.shape.rows()); ++row) {
    const Run all{row, around.box.first_sample - 1, around.shape.samples};
    std::span<const Run> there;
    if (!around.at_border(row)) there = runs_of(members, first, around.sector_row(row, beams));
    for_each_uncovered(all, there, [&](int from, int end) { out.push_back({row, from, end - from}); });
  }
  return out;
}

bool opens(std::span<const SampleFlags> flags, const Run& run) {
  const auto there = flags.subspan(static_cast<std::size_t>(run.first_sample), static_cast<std::size_t>(run.count));
  return std::any_of(there.begin(), there.end(), [](SampleFlags flag) { return any(flag & kNeverMember); });
}

double volume_of(const Run& run, const Sector& sector) {
  double shells = 0.0;
  for (int s = run.first_sample; s < run.end(); ++s) shells += sector.shell_m3_per_sr(s);
  return shells * sector.solid_angle_sr(run.row / sector.beams(), run.row % sector.beams());
}

struct Piece {
  bool open = false;
  int longest = 0;  ///< samples
  double volume_m3 = 0.0;
};

}  // namespace

EnclosedWater enclosed_water(const PingMask& mask, View3<const SampleFlags> flags, const Sector& sector,
                             double pulse_m) {
  const int beams = sector.beams();
  const Surroundings around(box_of(mask, beams));
  const std::vector<int> first = index_rows(mask.runs, flags.shape().rows());
  std::vector<Run> water = no_members(mask.runs, first, around, beams);
  const Components pieces = label_runs(water, around.shape, Connectivity::faces);
  std::vector<Piece> found(static_cast<std::size_t>(pieces.count));
  found.front().open = true;  // the first run is at the border, and all of that hangs together
  const auto piece_of = [&](std::size_t i) -> Piece& { return found[static_cast<std::size_t>(pieces.label[i])]; };
  for (std::size_t i = 0; i < water.size(); ++i) {
    Piece& piece = piece_of(i);
    if (piece.open) continue;
    water[i].row = around.sector_row(water[i].row, beams);
    piece.open = opens(flags.row(water[i].row), water[i]);
    piece.longest = std::max(piece.longest, static_cast<int>(water[i].count));
    piece.volume_m3 += volume_of(water[i], sector);
  }
  EnclosedWater out;
  for (std::size_t i = 0; i < water.size(); ++i) {
    if (!piece_of(i).open) out.runs.push_back(water[i]);
  }
  for (const Piece& piece : found) {
    if (piece.open) continue;
    out.volume_m3 += piece.volume_m3;
    if (piece.longest * sector.range().spacing_m < pulse_m) continue;
    ++out.vacuoles;
    out.vacuoles_m3 += piece.volume_m3;
  }
  return out;
}

std::vector<Run> core_runs(const std::vector<Run>& runs, const Shape3& shape, int samples) {
  const std::vector<int> first = index_rows(runs, shape.rows());
  std::vector<Run> core;
  for (const Run& run : runs) {
    if (run.count <= 2 * samples) continue;
    const NeighbourRows around = neighbour_rows(run.row, shape, Connectivity::faces);
    if (around.count < 4) continue;
    std::vector<Run> left{{run.row, run.first_sample + samples, run.count - 2 * samples}};
    for (int n = 0; n < around.count; ++n) {
      std::vector<Run> common;
      for (const Run& part : left) {
        for (const Run& beside : runs_of(runs, first, around.row[n])) {
          const int from = std::max(part.first_sample, beside.first_sample);
          const int end = std::min(part.end(), beside.end());
          if (from < end) common.push_back({run.row, from, end - from});
        }
      }
      left = std::move(common);
    }
    core.insert(core.end(), left.begin(), left.end());
  }
  return core;
}

}  // namespace sonar
