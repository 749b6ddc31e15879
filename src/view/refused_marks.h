// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/beam_grid.h"
#include "model/refused_echo.h"
#include "view/frame_description.h"
#include "view/key_rows.h"
#include "view/slices/slice.h"
#include "view/theme.h"

namespace sonar {

// Echoes that detection refused are marked by diamonds, black on light pictures and white on dark ones, as no school is:
// schools have areas, lines and colours.

/// A refused echo of one ping.
struct RefusedMark {
  std::int64_t echo_id = 0;
  Voxel loudest;
  int fans = 1;  ///< of its box, with `beams` and `samples`
  int beams = 1;
  int samples = 1;
  bool chosen = false;  ///< highlighted
};
/// Of a ping; those whose loudest voxel the sector has not are left out.
/// rows    of the observation
/// sector  that they are drawn on
/// chosen  echo_id that is highlighted; 0 = none
[[nodiscard]] std::vector<RefusedMark> refused_marks(std::span<const RefusedEcho> rows, std::int64_t ping_index,
                                                     const BeamGrid& grid, const Sector& sector,
                                                     std::int64_t chosen = 0);

/// Where a slice shows an echo: at its loudest voxel, and in neighbouring fans, beams or samples as far as half its box
/// reaches. Empty where it does not meet it; may lie outside the map's picture.
[[nodiscard]] std::optional<PixelPoint> place_of(const SliceMap& map, const RefusedMark& mark);

/// A mark in a picture, for pointers.
struct PlacedMark {
  PixelPoint at;
  std::int64_t echo_id = 0;
};
/// The nearest within reach; empty where there is none.
[[nodiscard]] std::optional<std::int64_t> mark_at(std::span<const PlacedMark> marks, PixelPoint at, double reach_px);

/// Half a mark's width.
[[nodiscard]] double mark_reach_px(const Theme& theme);
void add_refused_mark(FrameDescription& frame, PixelPoint at, bool chosen, const Theme& theme);
/// What a mark is, for a picture's key.
inline constexpr const char* kRefusedWords = "echo that is no school";
[[nodiscard]] KeyEntry refused_key(const Theme& theme);

}  // namespace sonar
