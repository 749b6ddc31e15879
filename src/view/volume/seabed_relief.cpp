// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "view/axes.h"
#include "view/colour_map.h"
#include "view/maps/contours.h"
#include "view/volume/context_layout.h"

namespace sonar {
namespace {

constexpr double kLitSlope = 0.6;         ///< what the light makes of the usual slope
constexpr double kMostExaggerated = 100;  ///< beyond it the steps of a raster's figures would be lit
constexpr int kMostLines = 8;
constexpr Rgba8 kContour{16, 32, 52, 150};
constexpr Rgba8 kGridLine{16, 32, 52, 60};

float depth_at(const SeabedPatch& bed, int ix, int iy) {
  return bed.depth_m[static_cast<std::size_t>(iy) * static_cast<std::size_t>(bed.nx) + static_cast<std::size_t>(ix)];
}

/// Neither white nor black, so that light and shade still show, and muted: the echoes are what is looked at. 0 =
/// shallowest.
Rgba8 seabed_colour(double share) {
  constexpr double kGrey = 0.55;
  const Rgba8 c = colour_map(ColourMapName::deep).at(0.15 + 0.6 * std::clamp(share, 0.0, 1.0));
  const double grey = 0.299 * c.r + 0.587 * c.g + 0.114 * c.b;  // as bright as the colour (BT.601)
  const auto muted = [&](std::uint8_t v) { return static_cast<std::uint8_t>(std::lround(v + kGrey * (grey - v))); };
  return {muted(c.r), muted(c.g), muted(c.b), c.a};
}

/// The triangle that the light falls on: the same place, so many times as steep.
std::array<Point<Sonar>, 3> steeper(std::array<Point<Sonar>, 3> c, double times) {
  for (Point<Sonar>& corner : c) corner.z *= times;
  return c;
}

void add_faces(ContextScene& scene, const SeabedPatch& bed, double transducer_depth_m, double low, double high) {
  const double times = relief_exaggeration(bed);
  const auto node = [&](int ix, int iy) {
    return Point<Sonar>{bed.first_x_m + ix * bed.spacing_m, bed.first_y_m + iy * bed.spacing_m,
                        static_cast<double>(depth_at(bed, ix, iy)) - transducer_depth_m};
  };
  const auto add = [&](const std::array<Point<Sonar>, 3>& c) {
    const double mean_depth = (c[0].z + c[1].z + c[2].z) / 3.0 + transducer_depth_m;
    // Land would hide the water that it stands beside.
    if (!(mean_depth > 0.0)) return;
    scene.opaque.push_back({c, lit(seabed_colour((mean_depth - low) / (high - low)), steeper(c, times))});
  };
  for (int iy = 0; iy + 1 < bed.ny; ++iy) {
    for (int ix = 0; ix + 1 < bed.nx; ++ix) {
      add({node(ix, iy), node(ix + 1, iy), node(ix, iy + 1)});
      add({node(ix + 1, iy), node(ix + 1, iy + 1), node(ix, iy + 1)});
    }
  }
}

void add_contours(ContextScene& scene, const SeabedPatch& bed, double transducer_depth_m, const Theme& theme,
                  double low, double high) {
  ScalarField field{{bed.nx, bed.ny}, bed.depth_m};
  for (float& depth : field.values) {
    if (!(depth > 0.0F)) depth = std::nanf("");  // land has none
  }
  const Unit unit = theme.units.length();
  for (const double tick : nice_ticks(unit.of(low), unit.of(high), kMostLines).major) {
    const double level = tick * unit.si;
    for (const ContourLine& line : contour_lines(field, level)) {
      const auto at = [&](std::size_t i) {
        const PixelPoint& p = line.points[i % line.points.size()];
        return Point<Sonar>{bed.first_x_m + p.x * bed.spacing_m, bed.first_y_m + p.y * bed.spacing_m,
                            level - transducer_depth_m};
      };
      for (std::size_t i = 1; i < line.points.size() + (line.closed ? 1 : 0); ++i) {
        scene.lines.push_back({at(i - 1), at(i), kContour, 1.2 * theme.line_px});
      }
    }
  }
}

/// Straight lines ahead and across, laid over the seabed: how it lies and how far it reaches.
void add_grid(ContextScene& scene, const SeabedPatch& bed, double transducer_depth_m, const Theme& theme) {
  const double width_m = bed.spacing_m * (bed.nx - 1);
  const double height_m = bed.spacing_m * (bed.ny - 1);
  const auto line = [&](bool ahead, double across_m) {
    const double first = ahead ? bed.first_y_m : bed.first_x_m;
    const int nodes = ahead ? bed.ny : bed.nx;
    const int below = std::clamp(static_cast<int>(std::floor((across_m - first) / bed.spacing_m)), 0, nodes - 2);
    const double share = (across_m - first) / bed.spacing_m - below;
    const int count = ahead ? bed.nx : bed.ny;
    Point<Sonar> before{0.0, 0.0, std::nan("")};
    for (int i = 0; i < count; ++i) {
      const double a = static_cast<double>(ahead ? depth_at(bed, i, below) : depth_at(bed, below, i));
      const double b = static_cast<double>(ahead ? depth_at(bed, i, below + 1) : depth_at(bed, below + 1, i));
      const double depth = a > 0.0 && b > 0.0 ? a + share * (b - a) : std::nan("");
      const double along = (ahead ? bed.first_x_m : bed.first_y_m) + i * bed.spacing_m;
      const Point<Sonar> here{ahead ? along : across_m, ahead ? across_m : along, depth - transducer_depth_m};
      if (std::isfinite(before.z) && std::isfinite(here.z)) {
        scene.lines.push_back({before, here, kGridLine, theme.line_px});
      }
      before = here;
    }
  };
  for (const double y : nice_ticks(bed.first_y_m, bed.first_y_m + height_m, 10).major) line(true, y);
  for (const double x : nice_ticks(bed.first_x_m, bed.first_x_m + width_m, 10).major) line(false, x);
}

}  // namespace

double relief_exaggeration(const SeabedPatch& bed) {
  double sum = 0.0;
  std::int64_t count = 0;
  for (int iy = 0; iy + 1 < bed.ny; ++iy) {
    for (int ix = 0; ix + 1 < bed.nx; ++ix) {
      const double here = static_cast<double>(depth_at(bed, ix, iy));
      const double ahead = static_cast<double>(depth_at(bed, ix + 1, iy));
      const double aside = static_cast<double>(depth_at(bed, ix, iy + 1));
      if (!(here > 0.0) || !(ahead > 0.0) || !(aside > 0.0)) continue;
      const double slope = std::hypot(ahead - here, aside - here) / bed.spacing_m;
      sum += slope * slope;
      ++count;
    }
  }
  const double usual = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
  return usual > 1e-9 ? std::clamp(kLitSlope / usual, 1.0, kMostExaggerated) : 1.0;
}

double depth_under(const SeabedPatch& bed, double x_m, double y_m) {
  const double u = (x_m - bed.first_x_m) / bed.spacing_m;
  const double v = (y_m - bed.first_y_m) / bed.spacing_m;
  if (bed.nx < 2 || bed.ny < 2 || !(u >= 0.0 && v >= 0.0 && u <= bed.nx - 1 && v <= bed.ny - 1)) return std::nan("");
  const int ix = std::min(static_cast<int>(u), bed.nx - 2);
  const int iy = std::min(static_cast<int>(v), bed.ny - 2);
  const auto along = [&](int row) {
    const auto left = static_cast<double>(depth_at(bed, ix, row));
    return left + (u - ix) * (static_cast<double>(depth_at(bed, ix + 1, row)) - left);
  };
  return along(iy) + (v - iy) * (along(iy + 1) - along(iy));
}

double seabed_line_step_m(const SeabedPatch& bed, const Units& units) {
  const auto span = depth_span(bed);
  const Unit unit = units.length();
  return span ? nice_ticks(unit.of(span->first), unit.of(span->second), kMostLines).step * unit.si : 0.0;
}

ColourMap seabed_colours() {
  constexpr int kKnots = 33;
  const std::array<Point<Sonar>, 3> level{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};
  ColourMap out;
  for (int i = 0; i < kKnots; ++i) out.knots.push_back(lit(seabed_colour(i / (kKnots - 1.0)), level));
  return out;
}

void add_seabed(ContextScene& scene, const SeabedPatch& bed, double transducer_depth_m, const Theme& theme) {
  const auto span = depth_span(bed);
  if (!span || bed.nx < 2 || bed.ny < 2) return;
  const auto [low, high] = *span;
  add_faces(scene, bed, transducer_depth_m, low, high);
  add_grid(scene, bed, transducer_depth_m, theme);
  add_contours(scene, bed, transducer_depth_m, theme, low, high);
}

}  // namespace sonar
