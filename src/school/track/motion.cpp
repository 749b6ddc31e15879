// SPDX-License-Identifier: Apache-2.0
#include "school/track/motion.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "geo/geodesic.h"
#include "model/school.h"

namespace sonar {
namespace {

/// Share of an extent -> variance: a uniform ellipsoid of extent L has variance L^2 / 20.
constexpr double kExtent2PerVariance = 20.0;

void add_direction(Covariance3& c, const Point<Enu>& u, double variance) {
  const std::array<double, 3> v{u.x, u.y, u.z};
  for (std::size_t a = 0, k = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b, ++k) c[k] += variance * v[a] * v[b];
  }
}

constexpr std::size_t packed(std::size_t a, std::size_t b) {
  constexpr std::size_t kIndex[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  return kIndex[a][b];
}

}  // namespace

PingFrame::PingFrame(const Placement& placement, const Geographic& origin) : placement_(placement) {
  const bool known = std::isfinite(placement.transducer.latitude_deg) && std::isfinite(origin.latitude_deg) &&
                     std::isfinite(placement.transducer.longitude_deg) && std::isfinite(origin.longitude_deg);
  // Whoever wants gaps in the navigation bridged hands in reckoned places; else the ship counts as standing still.
  if (known) transducer_ = to_enu(placement.transducer, origin);
  transducer_.z = -placement.transducer_depth_m;
  if (!std::isfinite(placement_.heading_rad)) placement_.heading_rad = 0.0;
}

Point<Enu> PingFrame::to_world(const Point<Sonar>& p) const {
  return transducer_ + to_enu(levelled(p, placement_), placement_.heading_rad);
}

Point<Sonar> PingFrame::from_world(const Point<Enu>& p) const {
  return unlevelled(to_sonar(p - transducer_, placement_.heading_rad), placement_);
}

Covariance3 turned(const Covariance3& c, double heading_rad) {
  // columns of the turn: images of the sonar axes
  const std::array<Point<Enu>, 3> image{to_enu(Point<Sonar>{1, 0, 0}, heading_rad),
                                        to_enu(Point<Sonar>{0, 1, 0}, heading_rad),
                                        to_enu(Point<Sonar>{0, 0, 1}, heading_rad)};
  double r[3][3];
  for (std::size_t i = 0; i < 3; ++i) {
    r[0][i] = image[i].x;
    r[1][i] = image[i].y;
    r[2][i] = image[i].z;
  }
  Covariance3 out{};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) out[packed(a, b)] += r[a][i] * c[packed(i, j)] * r[b][j];
      }
    }
  }
  return out;
}

Covariance3 centre_covariance(const Point<Sonar>& centre, const Covariance3& shape, double heading_rad, double share,
                              double least_m, double censored_m, std::int32_t edge_flags) {
  Covariance3 c = turned(shape, heading_rad);
  for (double& v : c) v *= share * share * kExtent2PerVariance;
  for (const std::size_t k : {std::size_t{0}, std::size_t{3}, std::size_t{5}}) c[k] += least_m * least_m;
  const double range = norm(centre);
  const double level = std::hypot(centre.x, centre.y);
  if (!(range > 0.0) || !(level > 0.0)) return c;
  const double variance = censored_m * censored_m;
  const Point<Sonar> along = centre * (1.0 / range);
  const Point<Sonar> sideways{-centre.y / level, centre.x / level, 0.0};
  const Point<Sonar> up{-along.z * centre.x / level, -along.z * centre.y / level, level / range};
  if ((edge_flags & (kEdgeFore | kEdgeAft)) != 0) add_direction(c, to_enu(sideways, heading_rad), variance);
  if ((edge_flags & (kEdgeNear | kEdgeFar)) != 0) add_direction(c, to_enu(along, heading_rad), variance);
  if ((edge_flags & (kEdgeTopFan | kEdgeBottomFan | kEdgeSurface | kEdgeSeabed)) != 0) {
    add_direction(c, to_enu(up, heading_rad), variance);
  }
  return c;
}

Motion::Motion(const Point<Enu>& position, const Covariance3& position_covariance, double speed_spread_mps) {
  state_ = {position.x, position.y, position.z, 0.0, 0.0, 0.0};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) p_[a][b] = position_covariance[packed(a, b)];
    p_[a + 3][a + 3] = speed_spread_mps * speed_spread_mps;
  }
}

void Motion::predict(double seconds, double acceleration_mps2) {
  const double q = acceleration_mps2 * acceleration_mps2;
  const double t2 = seconds * seconds;
  for (std::size_t a = 0; a < 3; ++a) state_[a] += seconds * state_[a + 3];
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      p_[a][b] += seconds * (p_[a + 3][b] + p_[a][b + 3]) + t2 * p_[a + 3][b + 3];
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      p_[a][b + 3] += seconds * p_[a + 3][b + 3];
      p_[b + 3][a] = p_[a][b + 3];
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    p_[a][a] += q * t2 * t2 / 4.0;
    p_[a][a + 3] += q * t2 * seconds / 2.0;
    p_[a + 3][a] = p_[a][a + 3];
    p_[a + 3][a + 3] += q * t2;
  }
}

bool Motion::inverse_innovation(const Covariance3& covariance, Matrix3& inverse) const {
  double s[3][3];
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) s[a][b] = p_[a][b] + covariance[packed(a, b)];
  }
  const auto minor = [&](std::size_t i, std::size_t j) {
    const std::size_t i1 = (i + 1) % 3;
    const std::size_t i2 = (i + 2) % 3;
    const std::size_t j1 = (j + 1) % 3;
    const std::size_t j2 = (j + 2) % 3;
    return s[i1][j1] * s[i2][j2] - s[i1][j2] * s[i2][j1];
  };
  const double determinant = s[0][0] * minor(0, 0) + s[0][1] * minor(0, 1) + s[0][2] * minor(0, 2);
  if (!(determinant > 0.0) || !std::isfinite(determinant)) return false;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) inverse[a][b] = minor(b, a) / determinant;
  }
  return true;
}

double Motion::distance2(const Point<Enu>& position, const Covariance3& covariance) const {
  Matrix3 inverse{};
  if (!inverse_innovation(covariance, inverse)) return std::numeric_limits<double>::infinity();
  const std::array<double, 3> d{position.x - state_[0], position.y - state_[1], position.z - state_[2]};
  double sum = 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) sum += d[a] * inverse[a][b] * d[b];
  }
  return sum;
}

void Motion::update(const Point<Enu>& position, const Covariance3& covariance) {
  Matrix3 inverse{};
  if (!inverse_innovation(covariance, inverse)) return;
  const std::array<double, 3> d{position.x - state_[0], position.y - state_[1], position.z - state_[2]};
  double gain[6][3];
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      gain[a][b] = p_[a][0] * inverse[0][b] + p_[a][1] * inverse[1][b] + p_[a][2] * inverse[2][b];
    }
  }
  for (std::size_t a = 0; a < 6; ++a) state_[a] += gain[a][0] * d[0] + gain[a][1] * d[1] + gain[a][2] * d[2];
  const auto before = p_;
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = 0; b < 6; ++b) {
      p_[a][b] -= gain[a][0] * before[0][b] + gain[a][1] * before[1][b] + gain[a][2] * before[2][b];
    }
  }
  for (std::size_t a = 0; a < 6; ++a) {
    for (std::size_t b = a + 1; b < 6; ++b) p_[a][b] = p_[b][a] = (p_[a][b] + p_[b][a]) / 2.0;
  }
}

}  // namespace sonar
