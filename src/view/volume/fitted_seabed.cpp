// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "view/axes.h"
#include "view/volume/context_layout.h"

namespace sonar {
namespace {

constexpr int kMostLines = 10;

}  // namespace

void add_fitted_seabed(ContextScene& scene, const FittedSeabed& bed, const Theme& theme) {
  if (!(bed.max_x > bed.min_x) || !(bed.max_y > bed.min_y)) return;
  const auto at = [&](double x, double y) { return Point<Sonar>{x, y, bed.z_at(x, y)}; };
  const std::array<Point<Sonar>, 4> c{at(bed.min_x, bed.min_y), at(bed.max_x, bed.min_y), at(bed.max_x, bed.max_y),
                                      at(bed.min_x, bed.max_y)};
  const Rgba8 fill = with_alpha(theme.land, 190);
  scene.ground.push_back({{c[0], c[1], c[2]}, fill});
  scene.ground.push_back({{c[0], c[2], c[3]}, fill});
  const Rgba8 line = with_alpha(theme.muted, 80);
  for (const double x : nice_ticks(bed.min_x, bed.max_x, kMostLines).major) {
    add_straight(scene, at(x, bed.min_y), at(x, bed.max_y), line, theme.line_px);
  }
  for (const double y : nice_ticks(bed.min_y, bed.max_y, kMostLines).major) {
    add_straight(scene, at(bed.min_x, y), at(bed.max_x, y), line, theme.line_px);
  }
  for (std::size_t i = 0; i < c.size(); ++i) {
    add_straight(scene, c[i], c[(i + 1) % c.size()], with_alpha(theme.muted, 150), theme.line_px);
  }
}

}  // namespace sonar
