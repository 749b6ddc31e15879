// SPDX-License-Identifier: Apache-2.0
#include "school/measure/setup_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/units.h"
#include "geo/geodesic.h"
#include "school/measure/centre_track.h"

namespace sonar {
namespace {

constexpr std::size_t kLeastSchools = 3;
constexpr double kLeastShip_mps = 0.5;
/// Deviations of the ship's velocities from their mean, over their size, from which on drift and setup are told apart: two
/// courses 30 degrees apart.
constexpr double kLeastSpread = 0.25;
constexpr double kLeg_deg = 20.0;

/// Turn and stretch b of the ship's velocity, then the drift: u = b V + W in complex numbers, east + i north.
constexpr std::size_t kMost = 4;
using Vector = std::array<double, kMost>;
using Matrix = std::array<Vector, kMost>;

struct Fit {
  double likelihood = -std::numeric_limits<double>::infinity();
  double own_mps = 0.0;
  Vector value{};
  Matrix covariance{};
};

/// Inverse of the first n rows and columns, which are positive definite, by Gauss and Jordan; its determinant's logarithm.
double invert(Matrix& m, std::size_t n) {
  Matrix out{};
  double log_determinant = 0.0;
  for (std::size_t i = 0; i < n; ++i) out[i][i] = 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double pivot = m[i][i];
    log_determinant += std::log(pivot);
    for (std::size_t k = 0; k < n; ++k) {
      m[i][k] /= pivot;
      out[i][k] /= pivot;
    }
    for (std::size_t j = 0; j < n; ++j) {
      const double factor = m[j][i];
      if (j == i) continue;
      for (std::size_t k = 0; k < n; ++k) {
        m[j][k] -= factor * m[i][k];
        out[j][k] -= factor * out[i][k];
      }
    }
  }
  m = out;
  return log_determinant;
}

/// Inverse of a sighting's covariance with the schools' own scatter in it.
struct Weight {
  double ee;
  double en;
  double nn;
  double log_determinant;
};
Weight weight_of(const SeenSpeed& one, double own_mps) {
  const double ee = one.school.variance_xx + own_mps * own_mps;
  const double nn = one.school.variance_yy + own_mps * own_mps;
  const double en = one.school.variance_xy;
  const double determinant = ee * nn - en * en;
  return {nn / determinant, -en / determinant, ee / determinant, std::log(determinant)};
}

/// n  2 = no drift, 4 = with it
Fit fit_with(const std::vector<SeenSpeed>& seen, double own_mps, std::size_t n) {
  Fit fit{0.0, own_mps, {}, {}};
  Vector right{};
  double square = 0.0;
  for (const SeenSpeed& one : seen) {
    const Weight w = weight_of(one, own_mps);
    const std::array<Vector, 2> design{Vector{one.ship_east_mps, -one.ship_north_mps, 1.0, 0.0},
                                       Vector{one.ship_north_mps, one.ship_east_mps, 0.0, 1.0}};
    const double u = one.school.slope_x;
    const double v = one.school.slope_y;
    for (std::size_t i = 0; i < n; ++i) {
      const double east = w.ee * design[0][i] + w.en * design[1][i];
      const double north = w.en * design[0][i] + w.nn * design[1][i];
      for (std::size_t k = 0; k < n; ++k) fit.covariance[i][k] += east * design[0][k] + north * design[1][k];
      right[i] += east * u + north * v;
    }
    square += w.ee * u * u + 2.0 * w.en * u * v + w.nn * v * v;
    fit.likelihood -= 0.5 * w.log_determinant;
  }
  fit.likelihood -= 0.5 * invert(fit.covariance, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) fit.value[i] += fit.covariance[i][k] * right[k];
    square -= fit.value[i] * right[i];
  }
  fit.likelihood -= 0.5 * square;
  return fit;
}

/// The likeliest scatter of the schools' own speeds, from 1 mm/s (none) on in steps of 5 %.
Fit likeliest(const std::vector<SeenSpeed>& seen, std::size_t n) {
  Fit best;
  for (double own_mps = 1e-3; own_mps < 5.0; own_mps *= 1.05) {
    const Fit fit = fit_with(seen, own_mps, n);
    if (fit.likelihood > best.likelihood) best = fit;
  }
  return best;
}

double course_deg(double east, double north) { return wrap_360(deg_from_rad(std::atan2(east, north))); }

/// Mean of a leg's schools along and across its course, each weighed by its error and the schools' own scatter.
CourseLeg leg_of(std::span<const SeenSpeed> seen, double own_mps) {
  CourseLeg leg{seen.front().time, seen.back().time, seen.size()};
  double east = 0.0;
  double north = 0.0;
  for (const SeenSpeed& one : seen) {
    east += one.ship_east_mps / static_cast<double>(seen.size());
    north += one.ship_north_mps / static_cast<double>(seen.size());
  }
  leg.course_deg = course_deg(east, north);
  leg.ship_mps = std::hypot(east, north);
  const auto mean_along = [&](double x, double y) {
    double sum = 0.0;
    double weights = 0.0;
    for (const SeenSpeed& one : seen) {
      const LineFit& s = one.school;
      const double variance =
          x * x * s.variance_xx + 2.0 * x * y * s.variance_xy + y * y * s.variance_yy + own_mps * own_mps;
      sum += (x * s.slope_x + y * s.slope_y) / variance;
      weights += 1.0 / variance;
    }
    return std::pair(sum / weights, 1.0 / std::sqrt(weights));
  };
  const double s = std::sin(rad_from_deg(leg.course_deg));
  const double c = std::cos(rad_from_deg(leg.course_deg));
  std::tie(leg.along_mps, leg.along_se_mps) = mean_along(s, c);
  std::tie(leg.cross_mps, leg.cross_se_mps) = mean_along(c, -s);
  return leg;
}

std::vector<CourseLeg> legs_of(const std::vector<SeenSpeed>& seen, double own_mps) {
  std::vector<CourseLeg> legs;
  std::size_t first = 0;
  double east = 0.0;
  double north = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double turn = wrap_180(course_deg(seen[i].ship_east_mps, seen[i].ship_north_mps) - course_deg(east, north));
    if (i > first && std::abs(turn) > kLeg_deg) {
      legs.push_back(leg_of(std::span(seen).subspan(first, i - first), own_mps));
      first = i;
      east = north = 0.0;
    }
    east += seen[i].ship_east_mps;
    north += seen[i].ship_north_mps;
  }
  legs.push_back(leg_of(std::span(seen).subspan(first), own_mps));
  return legs;
}

struct ShipSpread {
  double rms_mps = 0.0;
  double about_mean = 0.0;  ///< of that
};
ShipSpread ship_spread(const std::vector<SeenSpeed>& seen) {
  const auto n = static_cast<double>(seen.size());
  double east = 0.0;
  double north = 0.0;
  double square = 0.0;
  for (const SeenSpeed& one : seen) {
    east += one.ship_east_mps / n;
    north += one.ship_north_mps / n;
    square += (one.ship_east_mps * one.ship_east_mps + one.ship_north_mps * one.ship_north_mps) / n;
  }
  const double about = std::max(square - east * east - north * north, 0.0);
  return {std::sqrt(square), square > 0.0 ? std::sqrt(about / square) : 0.0};
}

/// k e^(-ia) = 1 - b, and what the error of b makes of a and k.
void take_setup(const Fit& fit, SetupCheck& out) {
  const double real = 1.0 - fit.value[0];
  const double imaginary = -fit.value[1];
  const double k = std::hypot(real, imaginary);
  const double x = real / k;
  const double y = imaginary / k;
  const Matrix& c = fit.covariance;
  out.range_scale = k;
  out.range_scale_se = std::sqrt(x * x * c[0][0] + 2.0 * x * y * c[0][1] + y * y * c[1][1]);
  out.bearing_error_deg = deg_from_rad(-std::atan2(imaginary, real));
  out.bearing_error_se_deg = deg_from_rad(std::sqrt(y * y * c[0][0] - 2.0 * x * y * c[0][1] + x * x * c[1][1]) / k);
}

/// k R(a) W is what is fitted.
void take_drift(const Fit& fit, SetupCheck& out) {
  const double a = rad_from_deg(out.bearing_error_deg);
  const double c = std::cos(a) / out.range_scale;
  const double s = std::sin(a) / out.range_scale;
  out.drift_east_mps = c * fit.value[2] - s * fit.value[3];
  out.drift_north_mps = s * fit.value[2] + c * fit.value[3];
  out.drift_east_se_mps = std::sqrt(fit.covariance[2][2]);
  out.drift_north_se_mps = std::sqrt(fit.covariance[3][3]);
}

}  // namespace

std::optional<SeenSpeed> seen_speed(std::span<const SchoolPingRow> rows, std::span<const PingNavigation> pings,
                                    const SummariseParams& params) {
  const CentreTrack track = uncut_track(rows);
  if (!track.tells_speed(params.min_speed_pings, params.min_speed_span_s)) return std::nullopt;
  std::vector<double> east;
  std::vector<double> north;
  for (const std::size_t row : track.rows) {
    const std::int64_t ping = rows[row].ping_index;
    if (ping < 0 || ping >= static_cast<std::int64_t>(pings.size())) return std::nullopt;
    const PingNavigation& at = pings[static_cast<std::size_t>(ping)];
    if (!at.has_position()) return std::nullopt;
    const Point<Enu> place = to_enu(at.transducer, track.origin);
    east.push_back(place.x);
    north.push_back(place.y);
  }
  const LineFit ship = fit_line(track.places.t, east, north);
  const TimeNs middle = rows[track.rows[track.size() / 2]].time_utc;
  return SeenSpeed{middle, fit_line(track.places.t, track.places.x, track.places.y), ship.slope_x, ship.slope_y};
}

Result<SetupCheck> check_setup(std::vector<SeenSpeed> seen) {
  if (seen.size() < kLeastSchools) {
    return fail(ErrorCode::not_found, fmt::format("schools seen long enough for a speed: expected {} or more, found {}",
                                                  kLeastSchools, seen.size()));
  }
  std::stable_sort(seen.begin(), seen.end(), [](const SeenSpeed& a, const SeenSpeed& b) { return a.time < b.time; });
  const ShipSpread ship = ship_spread(seen);
  if (ship.rms_mps < kLeastShip_mps) {
    return fail(ErrorCode::not_found, fmt::format("the ship's speed where schools were seen: expected {} m/s or more, "
                                                  "found {:.2f}",
                                                  kLeastShip_mps, ship.rms_mps));
  }
  SetupCheck out;
  out.schools = seen.size();
  out.drift_known = ship.about_mean >= kLeastSpread;
  const Fit fit = likeliest(seen, out.drift_known ? 4 : 2);
  out.own_speed_mps = fit.own_mps;
  take_setup(fit, out);
  if (out.drift_known) take_drift(fit, out);
  out.legs = legs_of(seen, fit.own_mps);
  return out;
}

}  // namespace sonar
