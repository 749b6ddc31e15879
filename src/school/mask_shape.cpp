// SPDX-License-Identifier: Apache-2.0
#include "school/mask_shape.h"

#include <algorithm>
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

PrincipalAxes principal_axes(const Covariance3& c) {
  constexpr int kSweeps = 12;  // each squares what is left off the diagonal
  std::array<Vector3, 3> m{{{c[0], c[1], c[2]}, {c[1], c[3], c[4]}, {c[2], c[4], c[5]}}};
  std::array<Vector3, 3> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // the axes, so far
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t p = 0; p < 2; ++p) {
      for (std::size_t q = p + 1; q < 3; ++q) {
        if (m[p][q] == 0.0) continue;
        const double angle = 0.5 * std::atan2(2.0 * m[p][q], m[p][p] - m[q][q]);
        const double cosine = std::cos(angle);
        const double sine = std::sin(angle);
        const auto turn = [&](double& a, double& b) {
          const double old = a;
          a = cosine * old + sine * b;
          b = cosine * b - sine * old;
        };
        for (std::size_t k = 0; k < 3; ++k) turn(m[k][p], m[k][q]);
        for (std::size_t k = 0; k < 3; ++k) turn(m[p][k], m[q][k]);
        for (std::size_t k = 0; k < 3; ++k) turn(columns[p][k], columns[q][k]);
        m[p][q] = m[q][p] = 0.0;
      }
    }
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return m[a][a] > m[b][b]; });
  PrincipalAxes out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.variance[k] = m[order[k]][order[k]];
    out.axis[k] = columns[order[k]];
  }
  return out;
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
