// SPDX-License-Identifier: Apache-2.0
#include "view/refused_marks.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <variant>

#include "view/shapes.h"

namespace sonar {
namespace {

constexpr double kHalf_em = 0.6;

PathItem diamond(PixelPoint at, double half_px, Rgba8 colour, double width_px, Rgba8 fill = {0, 0, 0, 0}) {
  return polyline_item({{at.x, at.y - half_px}, {at.x + half_px, at.y}, {at.x, at.y + half_px}, {at.x - half_px, at.y}},
                       true, colour, width_px, fill);
}

/// A voxel of the same echo that the slice shows, where its box may reach so far: the rows tell its size, and not how it
/// lies about its loudest voxel.
std::optional<Voxel> shown_voxel(const Slice& slice, const RefusedMark& mark) {
  Voxel voxel = mark.loudest;
  const auto moved = [](int& from, int to, int size) {
    const bool near = std::abs(to - from) <= size / 2;
    from = to;
    return near;
  };
  bool near = true;
  if (const auto* top = std::get_if<TopSlice>(&slice)) near = moved(voxel.fan, top->fan, mark.fans);
  if (const auto* side = std::get_if<SideSlice>(&slice)) near = moved(voxel.beam, side->beam, mark.beams);
  if (const auto* range = std::get_if<RangeSlice>(&slice)) near = moved(voxel.sample, range->sample, mark.samples);
  return near ? std::optional(voxel) : std::nullopt;
}

}  // namespace

std::vector<RefusedMark> refused_marks(std::span<const RefusedEcho> rows, std::int64_t ping_index, const BeamGrid& grid,
                                       const Sector& sector, std::int64_t chosen) {
  std::vector<RefusedMark> marks;
  const std::vector<int> row_of_channel = grid.row_of_channel();
  const RangeAxis& range = sector.range();
  for (const RefusedEcho& echo : rows) {
    if (echo.ping_index != ping_index || echo.channel < 0 || echo.channel >= std::ssize(row_of_channel)) continue;
    const int row = row_of_channel[static_cast<std::size_t>(echo.channel)];
    if (row < 0 || row >= sector.fans() * sector.beams() || echo.sample < 0 || echo.sample >= range.count) continue;
    const double samples = echo.range_extent_m / range.spacing_m;
    marks.push_back({echo.echo_id,
                     {row / sector.beams(), row % sector.beams(), static_cast<int>(echo.sample)},
                     static_cast<int>(std::clamp<std::int64_t>(echo.n_fans, 0, sector.fans())),
                     static_cast<int>(std::clamp<std::int64_t>(echo.n_beams, 0, sector.beams())),
                     samples >= 0.0 && samples <= range.count ? static_cast<int>(std::lround(samples)) : 0,
                     echo.echo_id == chosen});
  }
  return marks;
}

std::optional<PixelPoint> place_of(const SliceMap& map, const RefusedMark& mark) {
  const auto voxel = shown_voxel(map.view().slice, mark);
  return voxel ? map.place_of(*voxel) : std::nullopt;
}

std::optional<std::int64_t> mark_at(std::span<const PlacedMark> marks, PixelPoint at, double reach_px) {
  std::optional<std::int64_t> nearest;
  for (const PlacedMark& mark : marks) {
    const double away = std::hypot(mark.at.x - at.x, mark.at.y - at.y);
    if (away > reach_px) continue;
    reach_px = away;
    nearest = mark.echo_id;
  }
  return nearest;
}

double mark_reach_px(const Theme& theme) { return kHalf_em * theme.text_px; }

void add_refused_mark(FrameDescription& frame, PixelPoint at, bool chosen, const Theme& theme) {
  const double half = mark_reach_px(theme);
  const double line = (chosen ? 2.8 : 1.4) * theme.line_px;
  frame.items.emplace_back(diamond(at, half, with_alpha(theme.halo, 255), line + 2.4 * theme.line_px));
  frame.items.emplace_back(diamond(at, half, theme.text, line));
}

KeyEntry refused_key(const Theme& theme) {
  return {kRefusedWords, [theme](FrameDescription& frame, const PixelRect& at) {
            add_refused_mark(frame, {at.x + 0.5 * at.width, at.y + 0.5 * at.height}, false, theme);
          }};
}

}  // namespace sonar
