// SPDX-License-Identifier: Apache-2.0
#include "render/ray_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kMostPixels = 16384;
constexpr std::size_t kMostVoxels = std::size_t{1} << 30U;

double dot(const Point<Sonar>& a, const Point<Sonar>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Point<Sonar> unit(const Point<Sonar>& p) {
  const double length = norm(p);
  return length > 0.0 ? p * (1.0 / length) : p;
}

double fract(double value) { return value - std::floor(value); }

/// Digits of n behind the point in the reverse order, 0..1.
double reversed(std::uint32_t n, std::uint32_t base) {
  double out = 0.0;
  for (double digit = 1.0 / base; n > 0; n /= base, digit /= base) out += digit * (n % base);
  return out;
}

/// Halton's sequence in the unit square, moved by half of what sixteen of its numbers leave between them: their mean is
/// the middle then.
PixelPoint spread(std::uint32_t n) { return {fract(reversed(n, 2) + 1.0 / 32.0), fract(reversed(n, 3) + 1.0 / 18.0)}; }

bool finite(const Point<Sonar>& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

int full_pixel(int i, int divisor, int count) { return std::min(i * divisor + divisor / 2, count - 1); }

PixelSize divided(PixelSize size, int divisor) {
  return {(size.width + divisor - 1) / divisor, (size.height + divisor - 1) / divisor};
}

double sample_phase(int x, int y, std::uint32_t jitter_frame) {
  if (jitter_frame == 0) {
    return 0.5;
  }
  const double noise = fract(52.9829189 * fract(0.06711056 * x + 0.00583715 * y));
  return fract(noise + 0.61803399 * jitter_frame);
}

PixelPoint pixel_shift(std::uint32_t jitter_frame) {
  if (jitter_frame == 0) return {0.0, 0.0};
  // Sixteen frames take the middles of a pixel's 4 x 4 parts, far ones after each other: bits of x and y by turns.
  const std::uint32_t n = jitter_frame - 1;
  const auto bit = [n](int i) { return n >> i & 1U; };
  const std::uint32_t column = 2 * bit(0) + bit(2);
  const std::uint32_t row = 2 * (bit(0) ^ bit(1)) + (bit(2) ^ bit(3));
  // The next sixteen take other places in these parts.
  const std::uint32_t round = n / 16;
  return {0.25 * (column + fract(0.5 + reversed(round, 2))) - 0.5,
          0.25 * (row + fract(0.5 + reversed(round, 3))) - 0.5};
}

std::array<std::array<float, 3>, kSkyRays> sky_rays(std::uint32_t jitter_frame) {
  // Within a quarter turn, and within a ring's half of the light, evenly from frame to frame.
  const PixelPoint at = jitter_frame == 0 ? PixelPoint{0.5, 0.5} : spread(jitter_frame);
  std::array<std::array<float, 3>, kSkyRays> out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double ring = static_cast<double>(i / 4);
    // The cosine law: sine^2 of the angle off the normal is even.
    const double sine2 = 0.5 * (ring + at.x);
    const double azimuth = 0.5 * std::numbers::pi * (static_cast<double>(i % 4) + at.y + 0.5 * ring);
    const double sine = std::sqrt(sine2);
    out[i] = {static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
              static_cast<float>(std::sqrt(1.0 - sine2))};
  }
  return out;
}

Point<Sonar> light_direction(const CameraBasis& camera) {
  return unit(camera.up * 0.6 - camera.right * 0.5 - camera.forward);
}

std::array<double, 3> lit(const std::array<double, 3>& rgb, const Point<Sonar>& gradient_db_per_m,
                          const Point<Sonar>& light, const Point<Sonar>& ray, const Lighting& lighting, double sky) {
  const double length = norm(gradient_db_per_m);
  if (!lighting.on || !(length > 0.0)) {
    return rgb;
  }
  const Point<Sonar> n = gradient_db_per_m * (-1.0 / length);
  const double w = std::min(1.0, length / static_cast<double>(lighting.full_gradient_db_per_m));
  const double diffuse = std::max(0.0, dot(n, light));
  const double gloss = std::pow(std::max(0.0, dot(n, unit(light - ray))), 16.0);
  const double scale =
      1.0 - w + w * (static_cast<double>(lighting.ambient) * sky + static_cast<double>(lighting.diffuse) * diffuse);
  const double white = w * static_cast<double>(lighting.specular) * gloss;
  return {rgb[0] * scale + white, rgb[1] * scale + white, rgb[2] * scale + white};
}

Result<void> check_volume(const VolumeData& volume) {
  const Shape3 shape = volume.sv.shape();
  if (shape.fans < 2 || shape.beams < 2 || shape.samples < 2) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a volume of {} x {} x {} (fans, beams, samples) cannot be drawn; 2 of each are the least",
                            shape.fans, shape.beams, shape.samples));
  }
  const Sector& sector = volume.sector;
  if (sector.fans() != shape.fans || sector.beams() != shape.beams || sector.range().count != shape.samples) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("the sector ({} x {} x {}) and the volume ({} x {} x {}) differ", sector.fans(),
                            sector.beams(), sector.range().count, shape.fans, shape.beams, shape.samples));
  }
  if (shape.size() > kMostVoxels) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a volume of {} samples; {} are the most", shape.size(), kMostVoxels));
  }
  if (!(sector.range().range_m(shape.samples - 1) > std::max(0.0, sector.range().first_m))) {
    return fail(ErrorCode::bad_parameter, "a volume whose ranges all lie at or behind the transducer");
  }
  const auto all = volume.sv.all();
  if (std::all_of(all.begin(), all.end(), [](std::int16_t v) { return v == kNoData; })) {
    return fail(ErrorCode::bad_parameter, "a ping without data: no sample of the volume is known");
  }
  return {};
}

Result<void> check_transfer(const OpticalTable& table) {
  const std::size_t entries = table.rgb_extinction.size();
  if (entries < 2 || entries > static_cast<std::size_t>(kMostTableEntries)) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a transfer table has {} entries; expected 2 to {}", entries, kMostTableEntries));
  }
  if (!std::isfinite(table.first_db) || !std::isfinite(table.last_db) || !(table.first_db < table.last_db)) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a transfer table reaches from {} to {} dB; expected rising limits", table.first_db,
                            table.last_db));
  }
  for (std::size_t i = 0; i < entries; ++i) {
    for (const float value : table.rgb_extinction[i]) {
      if (!std::isfinite(value) || value < 0.0F) {
        return fail(ErrorCode::bad_parameter,
                    fmt::format("entry {} of a transfer table holds {}; expected numbers from 0", i, value));
      }
    }
  }
  return {};
}

Result<void> check_view(const VolumeView& view, const DrawQuality& quality) {
  const PixelSize size = view.size;
  if (size.width < 1 || size.height < 1 || size.width > kMostPixels || size.height > kMostPixels) {
    return fail(ErrorCode::bad_parameter, fmt::format("a picture of {} x {} pixels; expected 1 to {} a side",
                                                      size.width, size.height, kMostPixels));
  }
  if (quality.divisor < 1 || quality.divisor > kMostPixels) {
    return fail(ErrorCode::bad_parameter, fmt::format("a picture divided by {}; expected 1 or more", quality.divisor));
  }
  if (!(quality.step_samples >= 1e-3) || quality.step_samples > 1e3) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a step of {} samples; expected 0.001 to 1000", quality.step_samples));
  }
  if (!std::isfinite(quality.homogeneous_limit) || quality.homogeneous_limit < 0.0) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a homogeneous limit of {}; expected 0 or more", quality.homogeneous_limit));
  }
  if (view.opaque_m != nullptr && view.opaque_m->size() != size.count()) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("opaque distances for {} pixels in a picture of {}", view.opaque_m->size(), size.count()));
  }
  if (!finite(view.camera.eye) || !finite(view.camera.target) || !finite(view.camera.up) ||
      !std::isfinite(view.camera.vertical_fov_rad) || std::isnan(view.first_hit_db) ||
      !std::isfinite(view.cue.nearest_m) || !std::isfinite(view.cue.farthest_m) ||
      !std::isfinite(view.lighting.occlusion_m)) {
    return fail(ErrorCode::bad_parameter, "a camera, a level or a distance that is not a number");
  }
  return {};
}

}  // namespace sonar
