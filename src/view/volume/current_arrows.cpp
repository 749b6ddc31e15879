// SPDX-License-Identifier: Apache-2.0
#include "view/volume/current_arrows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.h"
#include "view/axes.h"
#include "view/colour_map.h"
#include "view/volume/context_layout.h"

namespace sonar {
namespace {

constexpr double kLongest = 0.25;    ///< of the range
constexpr double kHead = 0.3;        ///< of an arrow's length
constexpr double kSecondHead = 0.6;  ///< of a head's length behind the first
constexpr int kMostArrows = 15;

}  // namespace

std::vector<double> current_depths(const Sector& sector, double transducer_depth_m, const Units& units) {
  const double below_m = std::max(0.0, -std::sin(sector.elevation_rad(0)) * far_range_m(sector));
  const double deepest_m = transducer_depth_m + below_m;
  std::vector<double> out;
  const Unit unit = units.length();
  for (const double tick : nice_ticks(0.0, unit.of(std::max(deepest_m, 1.0)), kMostArrows).major) {
    const double depth_m = tick * unit.si;
    if (depth_m > 0.0 && depth_m <= deepest_m) out.push_back(depth_m);
  }
  return out;
}

std::optional<CurrentScale> current_scale(const Sector& sector, const CurrentColumn& column, const Units& units) {
  if (!(column.longest_mps >= kLeastCurrent_mps)) return std::nullopt;
  const double metres_per_mps = round_below(kLongest * far_range_m(sector) / column.longest_mps, {});
  const double speed_mps = round_below(column.longest_mps, units.speed());
  return CurrentScale{speed_mps, speed_mps * metres_per_mps};
}

std::string current_words(const Sector& sector, const CurrentColumn& column, const std::optional<double>& heading_deg,
                          const Units& units) {
  const auto arrows = current_arrows(sector, column, heading_deg, 0.0);
  if (arrows.empty()) return {};
  const bool cut = std::any_of(arrows.begin(), arrows.end(), [](const CurrentArrow& arrow) { return arrow.cut; });
  const auto scale = current_scale(sector, column, units);
  return fmt::format("current below the ship: {} is {} long", round_text(scale->speed_mps, units.speed()),
                     round_text(scale->length_m, units.length())) +
         (cut ? fmt::format("; two heads: above {}", quantity_text(column.longest_mps, 2, units.speed()))
              : std::string());
}

std::vector<CurrentArrow> current_arrows(const Sector& sector, const CurrentColumn& column,
                                         const std::optional<double>& heading_deg, double transducer_depth_m) {
  std::vector<CurrentArrow> out;
  const auto scale = current_scale(sector, column);
  if (!scale || !heading_deg) return out;
  const double metres_per_mps = scale->length_m / scale->speed_mps;
  for (const CurrentAt& current : column.at) {
    const double speed_mps = std::hypot(current.east_mps, current.north_mps);
    if (speed_mps < kLeastCurrent_mps) continue;
    const bool cut = speed_mps > column.longest_mps;
    const double metres = cut ? metres_per_mps * column.longest_mps / speed_mps : metres_per_mps;
    const Point<Sonar> from{0.0, 0.0, current.depth_m - transducer_depth_m};
    const Point<Enu> way{current.east_mps * metres, current.north_mps * metres, 0.0};
    out.push_back({from, from + to_sonar(way, rad_from_deg(*heading_deg)), current.depth_m, cut});
  }
  return out;
}

Rgba8 current_colour() { return colour_map(ColourMapName::viridis).at(0.5); }

void add_current_arrows(ContextScene& scene, const std::vector<CurrentArrow>& arrows, double transducer_depth_m,
                        const Theme& theme) {
  if (arrows.empty()) return;
  const Rgba8 colour = current_colour();
  const double width_px = 2.0 * theme.line_px;
  add_straight(scene, {0.0, 0.0, -transducer_depth_m}, arrows.back().from, colour, theme.line_px);
  for (const CurrentArrow& arrow : arrows) {
    add_straight(scene, arrow.from, arrow.to, colour, width_px);
    const Point<Sonar> back = (arrow.from - arrow.to) * kHead;
    // Level barbs and upright ones: seen from above and from the side it stays an arrow.
    const std::array<Point<Sonar>, 4> sides{{{-0.5 * back.y, 0.5 * back.x, 0.0},
                                             {0.5 * back.y, -0.5 * back.x, 0.0},
                                             {0.0, 0.0, 0.5 * norm(back)},
                                             {0.0, 0.0, -0.5 * norm(back)}}};
    for (const Point<Sonar>& side : sides) {
      scene.lines.push_back({arrow.to, arrow.to + back + side, colour, width_px});
      if (!arrow.cut) continue;
      const Point<Sonar> behind = arrow.to + back * kSecondHead;
      scene.lines.push_back({behind, behind + back + side, colour, width_px});
    }
  }
}

}  // namespace sonar
