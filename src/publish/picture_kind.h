// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sonar {

/// The kinds of picture, in the order of picture_kinds().
enum class PictureKind : std::uint8_t {
  slice_top,
  slice_side,
  slice_range,
  slice_plane,
  volume,
  propagation,
  observation_map,
  survey_map,
  timeline,
  echogram,
  chart,
  frequency,
  curves,
  noise_steps,
  lineage,
  movie,
  report,
};

/// Whether it is one picture, which picture_frame() makes; a movie is many.
[[nodiscard]] constexpr bool is_one_picture(PictureKind kind) { return kind != PictureKind::movie; }

struct PictureKindInfo {
  std::string_view name;
  std::string_view text;
};
[[nodiscard]] std::span<const PictureKindInfo> picture_kinds();

/// Names of the kinds that `suits` stands for: between blanks; one that ends with - stands for all that begin so; empty =
/// all kinds.
[[nodiscard]] std::vector<std::string> kinds_suited(std::string_view suits);

}  // namespace sonar
