// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "view/volume/context_layout.h"

namespace sonar {
namespace {

constexpr int kMuted = 150;  ///< alpha of a footprint, of 255

/// What a school covers, drawn on a level.
void add_footprint(ContextScene& scene, const SchoolPlace& school, const auto& z_at, double width_px) {
  const std::size_t corners = school.footprint.size();
  const auto at = [&](std::size_t i) {
    const Point<Sonar>& p = school.footprint[i % corners];
    return Point<Sonar>{p.x, p.y, z_at(p)};
  };
  for (std::size_t i = 0; i < corners; ++i) {
    scene.lines.push_back({at(i), at(i + 1), with_alpha(school.colour, kMuted), width_px});
  }
}

}  // namespace

void add_drop_lines(ContextScene& scene, const ContextParams& params, const Theme& theme) {
  for (const SchoolPlace& school : params.schools) {
    if (!school.drop_line) continue;
    const double width_px = (school.selected ? 2.0 : 1.2) * theme.line_px;
    const auto drop = [&](double z_m, const auto& z_at) {
      add_straight(scene, school.middle, {school.middle.x, school.middle.y, z_m}, school.colour, width_px);
      add_footprint(scene, school, z_at, theme.line_px);
    };
    const double surface_z_m = -params.transducer_depth_m;
    drop(surface_z_m, [&](const Point<Sonar>&) { return surface_z_m; });
    // Echoes below a fitted plane have no way down to it.
    if (!(school.seabed_z_m > school.middle.z)) continue;
    drop(school.seabed_z_m, [&](const Point<Sonar>& p) { return std::isnan(p.z) ? school.seabed_z_m : p.z; });
  }
}

}  // namespace sonar
