// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "render/over_pixel.h"
#include "render/volume_renderer.h"

namespace sonar {
namespace {

double squared(std::uint8_t a, std::uint8_t b) {
  const double d = static_cast<double>(a) - static_cast<double>(b);
  return d * d;
}

double psnr_of(double sum, double count) {
  return sum > 0.0 ? std::min(99.0, 10.0 * std::log10(255.0 * 255.0 * 3.0 * count / sum)) : 99.0;
}

double difference(const Image& a, const Image& b, int x0, int y0, int x1, int y1) {
  double sum = 0.0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const Rgba8& p = a.at(x, y);
      const Rgba8& q = b.at(x, y);
      sum += squared(p.r, q.r) + squared(p.g, q.g) + squared(p.b, q.b);
    }
  }
  return sum;
}

}  // namespace

Image over(const RayImage& rays, const Image& background) {
  SONAR_CHECK(rays.size == background.size);
  Image out(rays.size);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    out.pixels[i] = over_pixel(rays.rgba[i], background.pixels[i]);
  }
  return out;
}

Image over(const RayImage& rays, Rgba8 background) {
  Image out(rays.size);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    out.pixels[i] = over_pixel(rays.rgba[i], background);
  }
  return out;
}

double psnr_db(const Image& a, const Image& b) {
  SONAR_CHECK(a.size == b.size);
  return psnr_of(difference(a, b, 0, 0, a.size.width, a.size.height), static_cast<double>(a.size.count()));
}

double worst_tile_psnr_db(const Image& a, const Image& b, int tile) {
  SONAR_CHECK(a.size == b.size && tile > 0);
  double worst = 99.0;
  for (int y = 0; y < a.size.height; y += tile) {
    for (int x = 0; x < a.size.width; x += tile) {
      const int x1 = std::min(x + tile, a.size.width);
      const int y1 = std::min(y + tile, a.size.height);
      worst = std::min(worst, psnr_of(difference(a, b, x, y, x1, y1), static_cast<double>(x1 - x) * (y1 - y)));
    }
  }
  return worst;
}

}  // namespace sonar
