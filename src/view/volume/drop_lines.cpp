// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/volume/context_layout.h"

namespace sonar {
namespace {

constexpr double kRing = 0.012;  ///< radius of a drop line's ring, of the sonar's range
constexpr int kCorners = 16;

void add_ring(ContextScene& scene, const Point<Sonar>& middle, double radius_m, Rgba8 colour, double width_px) {
  Point<Sonar> before = middle + Point<Sonar>{radius_m, 0.0, 0.0};
  for (int i = 1; i <= kCorners; ++i) {
    const double turned = 2.0 * std::numbers::pi * i / kCorners;
    const Point<Sonar> here = middle + Point<Sonar>{radius_m * std::cos(turned), radius_m * std::sin(turned), 0.0};
    scene.lines.push_back({before, here, colour, width_px});
    before = here;
  }
}

}  // namespace

void add_drop_lines(ContextScene& scene, const Sector& sector, const ContextParams& params, const Theme& theme) {
  const double radius_m = kRing * far_range_m(sector);
  for (const SchoolPlace& school : params.schools) {
    if (!school.drop_line) continue;
    const double width_px = (school.selected ? 2.0 : 1.2) * theme.line_px;
    const auto drop = [&](double z_m) {
      const Point<Sonar> end{school.middle.x, school.middle.y, z_m};
      add_straight(scene, school.middle, end, school.colour, width_px);
      add_ring(scene, end, radius_m, school.colour, width_px);
    };
    drop(-params.transducer_depth_m);
    // Echoes below a fitted plane have no way down to it.
    if (school.seabed_z_m > school.middle.z) drop(school.seabed_z_m);
  }
}

}  // namespace sonar
