// SPDX-License-Identifier: Apache-2.0
#include "render/gl/grid_textures.h"

#include <algorithm>

#include "base/units.h"
#include "render/transfer_table.h"

namespace sonar {
namespace {

using Rg = std::array<float, 2>;
using Rgba = std::array<float, 4>;

void add_angles(const AngleTable& table, std::vector<Rg>& out) {
  for (std::size_t k = 0; k < table.value.size(); ++k) {
    const float next = table.value[std::min(k + 1, table.value.size() - 1)];
    out.push_back({table.value[k], next - table.value[k]});
  }
}

/// [beam - 1] values for each beam; the last cell's twice.
float slope(const std::vector<float>& per_rad, std::size_t i) { return per_rad[std::min(i, per_rad.size() - 1)]; }

/// A texture of cells from values that are filled up to whole rows.
template <class T>
Texture cell_texture(std::string_view label, std::vector<T> values, Texels texels) {
  const int rows = cell_rows(values.size());
  values.resize(static_cast<std::size_t>(rows) * kCellRow);
  return texture_2d(label, {kCellRow, rows}, texels, values.data());
}

}  // namespace

Texture angle_texture(const GridAxes& axes) {
  std::vector<Rg> entries;
  add_angles(axes.beam_of, entries);
  add_angles(axes.fan_of, entries);
  return texture_2d("angles", {kAngleEntries, 2}, Texels::rg32f, entries.data());
}

Texture faces_texture(const GridAxes& axes) {
  const auto width = static_cast<std::size_t>(std::max(axes.beams, axes.fans));
  std::vector<Rgba> entries(2 * width);
  for (std::size_t b = 0; b < axes.sin_azimuth.size(); ++b) {
    entries[b] = {axes.sin_azimuth[b], axes.cos_azimuth[b], slope(axes.beams_per_rad, b), 0.0F};
  }
  for (std::size_t f = 0; f < axes.sin2_elevation.size(); ++f) {
    entries[width + f] = {axes.sin2_elevation[f], 0.0F, slope(axes.fans_per_rad, f), 0.0F};
  }
  return texture_2d("cell faces", {static_cast<int>(width), 2}, Texels::rgba32f, entries.data());
}

Texture optics_texture(const OpticalTable& table, const TransferTable& fine) {
  std::vector<Rgba> entries;
  const double step_db = (table.last_db - table.first_db) / (fine.size() - 1);
  for (int i = 0; i < fine.size(); ++i) {
    const auto o = optics_at(table, table.first_db + i * step_db);
    entries.push_back({static_cast<float>(o[0]), static_cast<float>(o[1]), static_cast<float>(o[2]),
                       fine.extinction[static_cast<std::size_t>(i)]});
  }
  return texture_2d("transfer function", {fine.size(), 1}, Texels::rgba32f, entries.data());
}

int cell_rows(std::size_t cells) { return static_cast<int>((cells + kCellRow - 1) / kCellRow); }

Texture state_texture(const std::vector<std::uint8_t>& distance, const std::vector<std::uint8_t>& flags) {
  std::vector<std::array<std::uint8_t, 2>> state(distance.size());
  for (std::size_t i = 0; i < state.size(); ++i) {
    state[i] = {distance[i], flags[i]};
  }
  return cell_texture("cell states", std::move(state), Texels::rg8ui);
}

Texture means_texture(std::vector<std::array<float, 4>> means) {
  return cell_texture("cell means", std::move(means), Texels::rgba32f);
}

Texture largest_texture(std::vector<std::int16_t> largest) {
  return cell_texture("largest of cells", std::move(largest), Texels::r16i);
}

Texture sv_texture(const FoldPlan& plan, View3<const std::int16_t> sv, Voxels voxels) {
  const std::vector<std::int16_t> values = folded<std::int16_t>(plan, sv, kNoData);
  if (voxels != Voxels::float32) {
    return texture_3d("Sv", plan.texture, Voxels::snorm16, plan.channels, values.data());
  }
  const std::vector<float> floats(values.begin(), values.end());
  return texture_3d("Sv", plan.texture, Voxels::float32, plan.channels, floats.data());
}

Texture known_texture(const FoldPlan& plan, View3<const std::uint8_t> known) {
  std::vector<std::uint8_t> values = folded<std::uint8_t>(plan, known, 0);
  for (std::uint8_t& value : values) {
    value = value != 0 ? 255 : 0;
  }
  return texture_3d("known samples", plan.texture, Voxels::unorm8, plan.channels, values.data());
}

Texture mask_texture(const FoldPlan& plan, View3<const std::uint16_t> voxels) {
  const std::vector<std::uint16_t> values = folded<std::uint16_t>(plan, voxels, 0);
  return texture_3d("masks", plan.texture, Voxels::uint16, plan.channels, values.data());
}

Texture mask_colours(const MaskGrid& masks) {
  std::vector<Rgba> colours;
  for (const auto& c : masks.rgb) {
    colours.push_back({c[0], c[1], c[2], 1.0F});
  }
  return texture_2d("mask colours", {static_cast<int>(colours.size()), 1}, Texels::rgba32f, colours.data());
}

}  // namespace sonar
