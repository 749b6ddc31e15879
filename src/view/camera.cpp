// SPDX-License-Identifier: Apache-2.0
#include "view/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar {
namespace {

double dot(const Point<Sonar>& a, const Point<Sonar>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Point<Sonar> cross(const Point<Sonar>& a, const Point<Sonar>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Point<Sonar> unit(const Point<Sonar>& p, const Point<Sonar>& otherwise) {
  const double length = norm(p);
  return length > 1e-12 ? p * (1.0 / length) : otherwise;
}

/// Right-hand side of a look along `forward` with `up` upwards.
Point<Sonar> right_of(const Point<Sonar>& forward, const Point<Sonar>& up) {
  const Point<Sonar> right = cross(forward, up);
  if (norm(right) > 1e-9) {
    return unit(right, {});
  }
  // Straight along `up`: any perpendicular will do; the bow to the right is as good as another.
  const Point<Sonar> other = std::abs(forward.x) < 0.9 ? Point<Sonar>{1.0, 0.0, 0.0} : Point<Sonar>{0.0, 1.0, 0.0};
  return unit(other - forward * dot(other, forward), {0.0, 1.0, 0.0});
}

/// Rectangle of the picture that the sector's outline takes, pixels.
struct Extent {
  double left = 1e300, top = 1e300, right = -1e300, bottom = -1e300;
};

Extent extent(const Sector& sector, const CameraBasis& b) {
  Extent out;
  for (int fan = 0; fan < sector.fans(); ++fan) {
    for (int beam = 0; beam < sector.beams(); ++beam) {
      for (const int sample : {0, std::max(0, sector.range().count - 1)}) {
        const auto seen = b.project(sector.centre(fan, beam, sample));
        if (!seen) continue;
        out.left = std::min(out.left, seen->pixel.x);
        out.right = std::max(out.right, seen->pixel.x);
        out.top = std::min(out.top, seen->pixel.y);
        out.bottom = std::max(out.bottom, seen->pixel.y);
      }
    }
  }
  return out.left <= out.right ? out : Extent{0.0, 0.0, 1.0 * b.size.width, 1.0 * b.size.height};
}

}  // namespace

CameraBasis basis(const Camera& camera, PixelSize size) {
  CameraBasis out;
  out.eye = camera.eye;
  out.forward = unit(camera.target - camera.eye, {0.0, 0.0, 1.0});
  out.right = right_of(out.forward, unit(camera.up, {0.0, 0.0, -1.0}));
  out.up = cross(out.right, out.forward);
  out.tan_half_fov = std::tan(0.5 * std::clamp(camera.vertical_fov_rad, 1e-3, 3.0));
  out.size = size;
  return out;
}

Ray CameraBasis::ray(PixelPoint pixel) const {
  const double half = 0.5 * size.height;
  const double x = (pixel.x - 0.5 * size.width) / half * tan_half_fov;
  const double y = (half - pixel.y) / half * tan_half_fov;
  return {eye, unit(forward + right * x + up * y, forward)};
}

std::optional<CameraBasis::Projected> CameraBasis::project(const Point<Sonar>& point) const {
  const Point<Sonar> seen = point - eye;
  const double depth = dot(seen, forward);
  if (!(depth > 1e-6)) {
    return std::nullopt;
  }
  const double scale = 0.5 * size.height / (depth * tan_half_fov);
  return Projected{{0.5 * size.width + dot(seen, right) * scale, 0.5 * size.height - dot(seen, up) * scale}, depth};
}

Camera orbited(const Camera& camera, double azimuth_rad, double elevation_rad) {
  const Point<Sonar> arm = camera.eye - camera.target;
  const double distance = norm(arm);
  const double limit = 0.5 * std::numbers::pi - rad_from_deg(1.0);
  const double azimuth = std::atan2(arm.y, arm.x) + azimuth_rad;
  const double elevation =
      std::clamp(std::asin(std::clamp(-arm.z / std::max(distance, 1e-9), -1.0, 1.0)) + elevation_rad, -limit, limit);
  Camera out = camera;
  out.eye = camera.target + Sector::direction(elevation, azimuth) * distance;
  out.up = {0.0, 0.0, -1.0};
  return out;
}

Camera panned(const Camera& camera, double right, double up) {
  const CameraBasis b = basis(camera, {1, 1});
  const double height_m = 2.0 * b.tan_half_fov * norm(camera.target - camera.eye);
  const Point<Sonar> move = b.right * (right * height_m) + b.up * (up * height_m);
  Camera out = camera;
  out.eye = camera.eye + move;
  out.target = camera.target + move;
  return out;
}

Camera zoomed(const Camera& camera, double factor) {
  Camera out = camera;
  out.eye = camera.target + (camera.eye - camera.target) * std::clamp(factor, 1e-3, 1e3);
  return out;
}

Camera overview(const Sector& sector, PixelSize size) {
  const double far_m = std::max(1.0, sector.range().range_m(std::max(0, sector.range().count - 1)));
  const double azimuth = 0.5 * (sector.azimuth_rad(0) + sector.azimuth_rad(sector.beams() - 1));
  Camera camera;
  camera.target =
      Sector::direction(0.5 * (sector.elevation_rad(0) + sector.elevation_rad(sector.fans() - 1)), azimuth) *
      (0.55 * far_m);
  // From outside and beside the fan, so that it opens across the picture.
  const Point<Sonar> from = Sector::direction(rad_from_deg(32.0), azimuth + rad_from_deg(115.0));
  double distance = 2.0 * far_m;
  for (int i = 0; i < 8; ++i) {
    camera.eye = camera.target + from * distance;
    const CameraBasis b = basis(camera, size);
    const Extent seen = extent(sector, b);
    const double metres = 2.0 * b.tan_half_fov * distance / size.height;
    const double right = 0.5 * (seen.left + seen.right) - 0.5 * size.width;
    const double down = 0.5 * (seen.top + seen.bottom) - 0.5 * size.height;
    camera.target = camera.target + b.right * (right * metres) - b.up * (down * metres);
    distance *= std::max((seen.right - seen.left) / size.width, (seen.bottom - seen.top) / size.height) / 0.9;
    distance = std::max(distance, 0.5 * far_m);
  }
  camera.eye = camera.target + from * distance;
  return camera;
}

}  // namespace sonar
