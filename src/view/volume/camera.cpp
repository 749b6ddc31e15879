// SPDX-License-Identifier: Apache-2.0
#include "view/volume/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/units.h"
#include "view/volume/context_layout.h"

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

using Points = std::vector<Point<Sonar>>;

constexpr double kShip_m = 60.0;  ///< length of the ship that scenes show unless they are told

/// Places whose outline the picture is centred on: the ends of the beams, and the ship.
Points beam_ends(const Sector& sector) {
  Points out{{0.0, 0.0, 0.0}};
  for (int fan = 0; fan < sector.fans(); ++fan) {
    for (int beam = 0; beam < sector.beams(); ++beam) {
      for (const int sample : {0, std::max(0, sector.range().count - 1)}) {
        out.push_back(sector.centre(fan, beam, sample));
      }
    }
  }
  return out;
}

/// The ship and the outer surface of the sector's cells, a place every few degrees however wide the cells are.
Points outline(const Sector& sector, double far_m) {
  const auto angles = [](double lower, double upper) {
    const int steps = std::clamp(static_cast<int>((upper - lower) / rad_from_deg(4.0)) + 1, 1, 100);
    std::vector<double> out;
    for (int i = 0; i <= steps; ++i) out.push_back(lower + (upper - lower) * i / steps);
    return out;
  };
  Points out{{0.0, 0.0, 0.0}};
  const auto azimuths = angles(sector.azimuth_bounds(0).lower, sector.azimuth_bounds(sector.beams() - 1).upper);
  for (const double elevation :
       angles(sector.elevation_bounds(0).lower, sector.elevation_bounds(sector.fans() - 1).upper)) {
    for (const double azimuth : azimuths) out.push_back(Sector::direction(elevation, azimuth) * far_m);
  }
  return out;
}

/// Rectangle of the picture that the points take, pixels.
struct Extent {
  double left = 1e300, top = 1e300, right = -1e300, bottom = -1e300;

  [[nodiscard]] bool inside(PixelSize size) const {
    return left > 0.0 && top > 0.0 && right < size.width && bottom < size.height;
  }
};

/// Empty where a point lies behind the eye: such a picture cannot be measured.
std::optional<Extent> extent(const Points& points, const CameraBasis& b) {
  Extent out;
  for (const Point<Sonar>& point : points) {
    const auto seen = b.project(point);
    if (!seen) return std::nullopt;
    out.left = std::min(out.left, seen->pixel.x);
    out.right = std::max(out.right, seen->pixel.x);
    out.top = std::min(out.top, seen->pixel.y);
    out.bottom = std::max(out.bottom, seen->pixel.y);
  }
  return out;
}

bool shows(const Camera& camera, PixelSize size, const Points& points) {
  const auto seen = extent(points, basis(camera, size));
  return seen && seen->inside(size);
}

/// Comes nearer along the line of sight until the points take nine tenths of the picture, and no nearer than told.
/// Empty where a point comes to lie behind the eye.
std::optional<Camera> closed_in(Camera camera, PixelSize size, const Points& points, double nearest_m) {
  double distance = norm(camera.eye - camera.target);
  const Point<Sonar> from = (camera.eye - camera.target) * (1.0 / distance);
  for (int i = 0; i < 8; ++i) {
    camera.eye = camera.target + from * distance;
    const CameraBasis b = basis(camera, size);
    const auto seen = extent(points, b);
    if (!seen) return std::nullopt;
    const double metres = 2.0 * b.tan_half_fov * distance / size.height;
    const double right = 0.5 * (seen->left + seen->right) - 0.5 * size.width;
    const double down = 0.5 * (seen->top + seen->bottom) - 0.5 * size.height;
    camera.target = camera.target + b.right * (right * metres) - b.up * (down * metres);
    distance *= std::max((seen->right - seen->left) / size.width, (seen->bottom - seen->top) / size.height) / 0.9;
    distance = std::max(distance, nearest_m);
  }
  camera.eye = camera.target + from * distance;
  return camera;
}

/// Sees the sphere about the points' box, whatever their shape.
Camera round_all(const Points& points, const Point<Sonar>& from, PixelSize size) {
  Point<Sonar> least = points.front();
  Point<Sonar> most = points.front();
  for (const Point<Sonar>& p : points) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y), std::min(least.z, p.z)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y), std::max(most.z, p.z)};
  }
  Camera camera;
  camera.target = (least + most) * 0.5;
  double radius = 0.0;
  for (const Point<Sonar>& p : points) radius = std::max(radius, norm(p - camera.target));
  const double half_height = std::tan(0.5 * camera.vertical_fov_rad);
  const double half_width = half_height * size.width / size.height;
  camera.eye = camera.target + from * (1.1 * radius / std::sin(std::atan(std::min(half_height, half_width))));
  return camera;
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

Camera zoomed_about(const Camera& camera, const Point<Sonar>& about, double factor) {
  const double nearer = std::clamp(factor, 1e-3, 1e3);
  Camera out = camera;
  out.eye = about + (camera.eye - about) * nearer;
  out.target = about + (camera.target - about) * nearer;
  return out;
}

Camera seen_from(const Sector& sector, const Point<Sonar>& from, PixelSize size) {
  const double far_m = far_range_m(sector);
  Points all = outline(sector, far_m);
  // The ship's ends and its mast: from abeam they are what is nearest.
  for (const double x : {-kShip_m / 2.0, kShip_m / 2.0}) all.push_back({x, 0.0, -kShip_m / 2.0});
  const Camera outside = round_all(all, from, size);
  const auto nearer = closed_in(outside, size, all, 0.5 * far_m);
  return nearer && shows(*nearer, size, all) ? *nearer : outside;
}

Camera overview(const Sector& sector, PixelSize size) {
  const double far_m = far_range_m(sector);
  const double azimuth = 0.5 * (sector.azimuth_rad(0) + sector.azimuth_rad(sector.beams() - 1));
  Camera camera;
  camera.target =
      Sector::direction(0.5 * (sector.elevation_rad(0) + sector.elevation_rad(sector.fans() - 1)), azimuth) *
      (0.55 * far_m);
  // From outside and beside the fan, so that it opens across the picture.
  const Point<Sonar> from = Sector::direction(rad_from_deg(32.0), azimuth + rad_from_deg(115.0));
  camera.eye = camera.target + from * (2.0 * far_m);
  const Points all = outline(sector, far_m);
  const auto near = closed_in(camera, size, beam_ends(sector), 0.5 * far_m);
  if (near && shows(*near, size, all)) return *near;
  // Wide sectors lie round the eye so close; from outside their sphere none of it can be behind.
  const Camera outside = round_all(all, from, size);
  const auto nearer = closed_in(outside, size, all, 0.5 * far_m);
  return nearer && shows(*nearer, size, all) ? *nearer : outside;
}

}  // namespace sonar
