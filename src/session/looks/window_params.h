// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"
#include "view/units.h"

namespace sonar {

enum class ThemeName { system, light, dark };
inline constexpr std::array<std::string_view, 3> kThemeNames{"system", "light", "dark"};

/// What a user wants of the window itself.
struct WindowParams {
  ThemeName theme = ThemeName::light;
  double text_size_percent = 100.0;
  double memory_gb = 0.0;
  double play_rate = 2.0;
  bool play_loop = false;
  Units units;
};

template <class Visitor>
void describe(Visitor& v, WindowParams& p) {
  v.choice("theme", p.theme, kThemeNames,
           "Colours of the window and its pictures: light, dark for night watches, or as the desktop has them.");
  v.field("text_size_percent", p.text_size_percent,
          {.unit = "%",
           .min = 70,
           .max = 200,
           .text = "Size of the text in menus, lists and controls, of the usual one; 9 points at least. Text in "
                   "pictures follows their size."});
  v.field(
      "memory_gb", p.memory_gb,
      {.unit = "GB",
       .min = 0,
       .max = 1e6,
       .text = "Memory for the pings of the observation on show, 10^9 bytes; 0 = half of the machine's. It holds for "
               "observations that are opened from now on."});
  v.field(
      "play_rate", p.play_rate,
      {.unit = "pings/s", .min = 0, .max = 100, .text = "Pings a second that are played; 0 = as they were recorded."});
  v.field("play_loop", p.play_loop, {.text = "After the last ping comes the first."});
  v.choice("length_unit", p.units.lengths, kLengthUnitNames,
           "Depths, ranges and sizes that the window shows: metres, feet (0.3048 m) or fathoms (6 feet). Distances "
           "sailed stay "
           "in nautical miles; files, and what is typed in, in metres.");
  v.choice("speed_unit", p.units.speeds, kSpeedUnitNames,
           "Speeds that the window shows: knots of the ship and in the list of schools, else m/s, as is usual; or all "
           "alike. "
           "Files have m/s.");
}

}  // namespace sonar
