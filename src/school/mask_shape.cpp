// SPDX-License-Identifier: Apache-2.0
#include "school/mask_shape.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace sonar {

void add_square(Covariance3& sum, const Vector3& v, double weight) {
  for (std::size_t a = 0, k = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b, ++k) sum[k] += weight * v[a] * v[b];
  }
}

MaskShape shape_of(const PingMask& mask, const Sector& sector) {
  MaskShape shape;
  Vector3 sum{};
  Covariance3 square{};
  std::size_t i = 0;
  for (const Run& run : mask.runs) {
    const int fan = run.row / sector.beams();
    const int beam = run.row % sector.beams();
    const Point<Sonar> u = Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam));
    const double solid_angle = sector.solid_angle_sr(fan, beam);
    double w0 = 0.0;
    double w1 = 0.0;
    double w2 = 0.0;
    double shells = 0.0;
    for (int s = run.first_sample; s < run.end(); ++s, ++i) {
      const double range = sector.range().range_m(s);
      const double shell = sector.shell_m3_per_sr(s);
      const double w = shell * mask.confidence[i] / 255.0;
      shells += shell;
      w0 += w;
      w1 += w * range;
      w2 += w * range * range;
    }
    shape.volume_m3 += shells * solid_angle;
    shape.weight += w0 * solid_angle;
    const Vector3 e{u.x, u.y, u.z};
    for (std::size_t a = 0; a < 3; ++a) sum[a] += w1 * solid_angle * e[a];
    add_square(square, e, w2 * solid_angle);
  }
  if (!(shape.weight > 0.0)) return shape;
  const Vector3 c{sum[0] / shape.weight, sum[1] / shape.weight, sum[2] / shape.weight};
  shape.centre = {c[0], c[1], c[2]};
  for (std::size_t a = 0, k = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b, ++k) shape.covariance[k] = square[k] / shape.weight - c[a] * c[b];
  }
  return shape;
}

HorizontalAxes horizontal_axes(const Covariance3& covariance, double heading_rad) {
  const double mean = (covariance[0] + covariance[3]) / 2.0;
  const double half = (covariance[0] - covariance[3]) / 2.0;
  const double spread = std::hypot(half, covariance[1]);
  // angle of the major axis from the bow towards starboard; turning with the ship adds the heading
  double bearing = std::atan2(covariance[1], half) / 2.0 + heading_rad;
  bearing -= std::numbers::pi * std::floor(bearing / std::numbers::pi);
  if (bearing >= std::numbers::pi) bearing = 0.0;
  return {mean + spread, mean - spread, bearing};
}

}  // namespace sonar
