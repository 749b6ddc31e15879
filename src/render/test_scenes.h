// SPDX-License-Identifier: Apache-2.0
// Small volumes and views for the tests of this room.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/units.h"
#include "render/volume_renderer.h"
#include "view/volume/volume_scene.h"

namespace sonar::scenes {

/// Noise of a counter: -1..1, the same everywhere.
inline double noise(std::uint32_t i) {
  i = (i ^ 61U) ^ (i >> 16U);
  i *= 9U;
  i ^= i >> 4U;
  i *= 0x27d4eb2dU;
  i ^= i >> 15U;
  return static_cast<double>(i & 0xFFFFU) / 32767.5 - 1.0;
}

inline std::vector<double> even(double first_deg, double last_deg, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(rad_from_deg(first_deg + (last_deg - first_deg) * i / (count - 1)));
  return out;
}

/// The same limits with spacings that grow 1 : 2.
inline std::vector<double> uneven(double first_deg, double last_deg, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / (count - 1);
    out.push_back(rad_from_deg(first_deg + (last_deg - first_deg) * (2.0 * t + t * t) / 3.0));
  }
  return out;
}

/// Water at -78 dB with speckle, two dense balls and a shell of clutter near the transducer.
inline std::shared_ptr<VolumeData> volume(const Sector& sector, double speckle_db = 3.0) {
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  auto out = std::make_shared<VolumeData>(VolumeData{sector, Array3<std::int16_t>(shape), -1e9});
  const double far_m = sector.range().range_m(shape.samples - 1);
  const auto ball = [&](int f, int b, double part) {
    return Sector::direction(sector.elevation_rad(f), sector.azimuth_rad(b)) * (part * far_m);
  };
  const auto one = ball(shape.fans / 2, shape.beams / 2, 0.55);
  const auto two = ball(shape.fans / 4, 3 * shape.beams / 4, 0.8);
  std::uint32_t n = 0;
  for (int f = 0; f < shape.fans; ++f) {
    for (int b = 0; b < shape.beams; ++b) {
      for (int s = 0; s < shape.samples; ++s, ++n) {
        const auto p = sector.centre(f, b, s);
        double db = -78.0;
        if (norm(p - one) < 0.16 * far_m) db = -40.0;
        if (norm(p - two) < 0.10 * far_m) db = -48.0;
        if (sector.range().range_m(s) < 0.05 * far_m) db = -50.0;
        out->sv(f, b, s) = static_cast<std::int16_t>(std::lround(counts_from_db(db + speckle_db * noise(n))));
      }
    }
  }
  return out;
}

inline Sector fan(int samples = 120, double first_m = 0.0) {
  return {even(-45.0, 0.0, 10), even(-30.0, 30.0, 13), RangeAxis{first_m, 0.5, samples}};
}

/// Sparse (nothing below -62 dB) or dense (from -80 dB), as the benchmark's.
inline OpticalTable table(bool dense) {
  OpticalTable out;
  const auto mix = [](double x, double x0, double x1, double y0, double y1) {
    return x <= x0 ? y0 : (x >= x1 ? y1 : y0 + (x - x0) / (x1 - x0) * (y1 - y0));
  };
  for (int i = 0; i < 256; ++i) {
    const double db = -90.0 + 70.0 * i / 255.0;
    double e = mix(db, -55, -45, mix(db, -62, -55, 0.0, 0.01), 0.06);
    if (db > -45) e = mix(db, -45, -30, 0.06, 0.3);
    if (dense && db < -55) e = mix(db, -62, -55, mix(db, -80, -62, 0.0, 0.003), 0.01);
    out.rgb_extinction.push_back({static_cast<float>(mix(db, -80, -38, 0.05, 0.9)),
                                  static_cast<float>(mix(db, -70, -45, 0.2, 0.85)),
                                  static_cast<float>(mix(db, -55, -35, 0.8, 0.1)), static_cast<float>(e)});
  }
  return out;
}

inline Camera looking(const Point<Sonar>& eye, const Point<Sonar>& target) {
  Camera out;
  out.eye = eye;
  out.target = target;
  return out;
}

/// Every n by n pixels as one: n * n rays a pixel.
inline RayImage reduced(const RayImage& large, int n) {
  RayImage out{{large.size.width / n, large.size.height / n}, {}, {}};
  out.rgba.resize(out.size.count());
  for (int y = 0; y < large.size.height; ++y) {
    for (int x = 0; x < large.size.width; ++x) {
      const auto& from = large.rgba[static_cast<std::size_t>(y * large.size.width + x)];
      auto& to = out.rgba[static_cast<std::size_t>(y / n * out.size.width + x / n)];
      for (std::size_t c = 0; c < 4; ++c) to[c] += from[c] / static_cast<float>(n * n);
    }
  }
  return out;
}

}  // namespace sonar::scenes
