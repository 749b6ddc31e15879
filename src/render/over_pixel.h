// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "view/image.h"

namespace sonar {

/// A colour as r, g, b times alpha, and alpha; 0..1.
using Premultiplied = std::array<float, 4>;

inline Premultiplied premultiplied(Rgba8 c, double share = 1.0) {
  const auto a = static_cast<float>(c.a / 255.0 * share);
  const auto of = [a](std::uint8_t v) { return a * static_cast<float>(v) / 255.0F; };
  return {of(c.r), of(c.g), of(c.b), a};
}

inline void blend(Premultiplied& below, const Premultiplied& top) {
  for (std::size_t i = 0; i < 4; ++i) below[i] = top[i] + (1.0F - top[3]) * below[i];
}

inline std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

/// A ray's colour over a pixel.
inline Rgba8 over_pixel(const Premultiplied& ray, Rgba8 below) {
  if (ray == Premultiplied{} && below.a == 255) return below;
  const float rest = 1.0F - ray[3];
  const float below_alpha = static_cast<float>(below.a) / 255.0F;
  const float alpha = ray[3] + rest * below_alpha;
  if (alpha <= 0.0F) {
    return {0, 0, 0, 0};
  }
  const auto mix = [&](float colour, std::uint8_t under) {
    return byte_of((colour + rest * below_alpha * static_cast<float>(under) / 255.0F) / alpha);
  };
  return {mix(ray[0], below.r), mix(ray[1], below.g), mix(ray[2], below.b), byte_of(alpha)};
}

/// A pixel over another, both straight.
inline Rgba8 over_pixel(Rgba8 top, Rgba8 below) {
  if (top.a == 0 && below.a == 255) return below;
  Premultiplied colour = premultiplied(below);
  blend(colour, premultiplied(top));
  const float a = colour[3];
  const auto byte = [a](float v) { return byte_of(a > 0.0F ? v / a : 0.0F); };
  return {byte(colour[0]), byte(colour[1]), byte(colour[2]), static_cast<std::uint8_t>(std::lround(a * 255.0F))};
}

}  // namespace sonar
