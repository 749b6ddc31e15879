// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "base/units.h"
#include "render/volume_renderer.h"

// Small volumes for the tests of the back-end: three schools and some speckle on grids of every shape.

namespace sonar::gl_test {

struct Grid {
  const char* name;
  std::vector<double> elevation_deg;
  std::vector<double> azimuth_deg;
  RangeAxis range;
  double surface_z_m = -1e9;
};

inline std::vector<double> evenly(double first, double last, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(first + (last - first) * i / (count - 1));
  return out;
}

inline Sector sector_of(const Grid& grid) {
  const auto radians = [](std::vector<double> deg) {
    for (double& d : deg) d = rad_from_deg(d);
    return deg;
  };
  return {radians(grid.elevation_deg), radians(grid.azimuth_deg), grid.range};
}

/// -1..1, the same for the same number everywhere.
inline double noise(std::uint32_t n) {
  n = (n ^ 61U) ^ (n >> 16U);
  n *= 9U;
  n ^= n >> 4U;
  n *= 0x27d4eb2dU;
  n ^= n >> 15U;
  return static_cast<double>(n) / 2147483647.5 - 1.0;
}

/// -75 dB with 2 dB of speckle; three balls of -40 to -50 dB with soft rims, in parts of the grid's size.
inline std::shared_ptr<VolumeData> volume_of(const Grid& grid) {
  const Shape3 shape{static_cast<int>(grid.elevation_deg.size()), static_cast<int>(grid.azimuth_deg.size()),
                     grid.range.count};
  auto out = std::make_shared<VolumeData>(VolumeData{sector_of(grid), Array3<std::int16_t>(shape), grid.surface_z_m});
  constexpr double kBalls[3][5] = {
      {0.3, 0.3, 0.5, 0.2, -40.0}, {0.7, 0.6, 0.7, 0.25, -45.0}, {0.5, 0.8, 0.3, 0.15, -50.0}};
  std::uint32_t n = 0;
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < shape.samples; ++s) {
        double db = -75.0;
        for (const auto& ball : kBalls) {
          const double q = std::hypot((f + 0.5) / shape.fans - ball[0], (b + 0.5) / shape.beams - ball[1],
                                      (s + 0.5) / shape.samples - ball[2]) /
                           ball[3];
          db = std::max(db, ball[4] - 35.0 * std::max(0.0, q - 0.5) * 2.0);
        }
        out->sv(f, b, s) = static_cast<std::int16_t>(std::lround(counts_from_db(db + 2.0 * noise(n++))));
      }
    }
  }
  return out;
}

/// Transparent below -62 dB, or thin haze from -80 dB on; many-coloured.
inline OpticalTable table_of(bool haze, int entries = 256) {
  OpticalTable out{-90.0, -20.0, {}};
  for (int i = 0; i < entries; ++i) {
    const double db = -90.0 + 70.0 * i / (entries - 1);
    const double school = db < -62.0 ? 0.0 : std::min(0.3, 0.01 * std::pow((db + 62.0) / 7.0, 1.5));
    const double mist = haze && db > -80.0 ? 0.0008 * (db + 80.0) / 8.0 : 0.0;
    const double u = static_cast<double>(i) / (entries - 1);
    out.rgb_extinction.push_back({static_cast<float>(u), static_cast<float>(0.5 + 0.5 * std::sin(9.0 * u)),
                                  static_cast<float>(1.0 - u), static_cast<float>(school + mist)});
  }
  return out;
}

/// From outside, or from the middle of the sector.
inline VolumeView view_of(const Sector& sector, bool from_inside = false) {
  VolumeView view;
  view.size = {64, 48};
  view.camera = overview(sector);
  if (from_inside) {
    const double half = 0.5 * sector.range().range_m(sector.range().count - 1);
    view.camera.eye = Sector::direction(0.5 * (sector.elevation_rad(0) + sector.elevation_rad(sector.fans() - 1)),
                                        0.5 * (sector.azimuth_rad(0) + sector.azimuth_rad(sector.beams() - 1))) *
                      (0.7 * half);
    view.camera.target = view.camera.eye * 2.0 + Point<Sonar>{0.0, 20.0, 10.0};
    view.camera.vertical_fov_rad = 1.2;
  }
  return view;
}

inline Image on_black(const RayImage& rays) { return over(rays, Rgba8{0, 0, 0, 255}); }

inline const std::vector<Grid>& grids() {
  static const std::vector<Grid> all = {
      {"even", evenly(-45.0, 0.0, 10), evenly(60.0, 120.0, 13), {0.0, 1.0, 150}},
      {"uneven",
       {-44.0, -40.0, -33.0, -30.0, -22.0, -11.0, -8.0, -1.0},
       {-31.0, -28.0, -20.0, -17.0, -5.0, 4.0, 9.0, 24.0},
       {0.0, 1.0, 150}},
      {"far_first_range", evenly(-30.0, 20.0, 9), evenly(-30.0, 30.0, 9), {60.0, 0.8, 130}},
      {"negative_first_range", evenly(-45.0, -5.0, 9), evenly(60.0, 120.0, 9), {-7.3, 1.0, 150}},
      {"upwards", evenly(12.0, 50.0, 9), evenly(-30.0, 30.0, 9), {0.0, 1.0, 130}},
      {"surface", evenly(-40.0, 20.0, 9), evenly(-30.0, 30.0, 9), {0.0, 1.0, 150}, -9.0},
      {"wide", evenly(-50.0, 10.0, 9), evenly(-130.0, 130.0, 27), {5.0, 1.0, 120}},
      {"all_round", evenly(-60.0, -10.0, 9), evenly(-180.0, 180.0, 33), {0.0, 1.0, 120}},
      {"two_of_each", {-20.0, 10.0}, {-20.0, 15.0}, {0.0, 10.0, 12}},
  };
  return all;
}

/// Leaves the current context as badly as another painter could.
void spoil_state();

/// A box of the grid as a mask; confidence falls from 255 in its middle.
inline MaskLayer box_mask(Shape3 shape, std::array<double, 3> middle, double half, std::array<float, 3> rgb) {
  PingMask mask;
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      Run run{f * shape.beams + b, 0, 0};
      for (int s = 0; s < shape.samples; ++s) {
        const double q =
            std::max({std::abs((f + 0.5) / shape.fans - middle[0]), std::abs((b + 0.5) / shape.beams - middle[1]),
                      std::abs((s + 0.5) / shape.samples - middle[2])}) /
            half;
        if (q >= 1.0) continue;
        if (run.count == 0) run.first_sample = s;
        ++run.count;
        mask.confidence.push_back(quantised_confidence(1.0 - q * q));
      }
      if (run.count > 0) mask.runs.push_back(run);
    }
  }
  return {std::make_shared<const PingMask>(std::move(mask)), rgb};
}

inline std::vector<MaskLayer> two_masks(Shape3 shape) {
  return {box_mask(shape, {0.35, 0.35, 0.35}, 0.2, {1.0F, 0.8F, 0.1F}),
          box_mask(shape, {0.76, 0.76, 0.76}, 0.2, {0.1F, 0.9F, 0.2F})};
}

/// The second begins in the middle of the first.
inline std::vector<MaskLayer> overlapping_masks(Shape3 shape) {
  return {box_mask(shape, {0.4, 0.4, 0.4}, 0.3, {1.0F, 0.8F, 0.1F}),
          box_mask(shape, {0.55, 0.55, 0.55}, 0.3, {0.1F, 0.9F, 0.2F})};
}

}  // namespace sonar::gl_test
