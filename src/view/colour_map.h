// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "view/image.h"

namespace sonar {

/// The colour maps that every picture chooses from.
enum class ColourMapName : std::uint8_t {
  ek500,         ///< the field's twelve colours, one a 3 dB step, the last colour above
  ek500_smooth,  ///< the same colours, interpolated
  viridis,       ///< this and the maps below: even in lightness, safe for colour-blind eyes
  cividis,
  thermal,
  haline,
  dense,
  deep,  ///< for depth: pale = shallow
  grey,  ///< black = weak
  grey_inverted,
};
inline constexpr int kColourMaps = 10;

/// Names as users type them, in the order of the enum: "ek500", "ek500-smooth", "viridis", ...
[[nodiscard]] std::span<const std::string_view> colour_map_names();
[[nodiscard]] std::optional<ColourMapName> colour_map_named(std::string_view name);

/// A colour map from 0 (weakest) to 1 (strongest).
struct ColourMap {
  std::vector<Rgba8> knots;  ///< even steps; stepped: colour of each step
  bool stepped = false;      ///< n colours share 0..1 in equal steps, none is mixed

  /// Opaque colour at t; t outside 0..1 takes the end's colour, NaN the first.
  [[nodiscard]] Rgba8 at(double t) const;
};

/// One of the maps above; made once, lasting, safe to use from any thread.
[[nodiscard]] const ColourMap& colour_map(ColourMapName name);

/// CIE L* (0..100) of an sRGB colour: how light it looks.
[[nodiscard]] double lightness(Rgba8 colour);

}  // namespace sonar
