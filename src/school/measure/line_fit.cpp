// SPDX-License-Identifier: Apache-2.0
#include "school/measure/line_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/check.h"

namespace sonar {
namespace {

/// Correlation times that are tried, in median intervals; 0 = none, the others half an octave apart.
constexpr std::array<double, 17> kIntervals = {0.0, 0.3, 0.5,  0.7,  1.0,  1.4,  2.0,  2.8, 4.0,
                                               5.6, 8.0, 11.0, 16.0, 22.0, 32.0, 45.0, 64.0};

/// By how much a longer correlation time must be more likely.
constexpr double kGain = 1e-6;

struct Centred {
  std::vector<double> t;  ///< less its mean; so x and y
  std::vector<double> x;
  std::vector<double> y;
  double tt = 0.0;
};

std::vector<double> centred(std::vector<double> values) {
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (double& v : values) v -= mean;
  return values;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double median_interval(std::span<const TimedPlaces> pieces) {
  std::vector<double> intervals;
  for (const TimedPlaces& piece : pieces) {
    for (std::size_t i = 1; i < piece.t.size(); ++i) intervals.push_back(piece.t[i] - piece.t[i - 1]);
  }
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

/// Correlation of each deviation with the one before; none of the first.
std::vector<double> correlations(const std::vector<double>& t, double tau) {
  constexpr double kMost = 1.0 - 1e-9;  // two instants that are one
  std::vector<double> phi(t.size(), 0.0);
  for (std::size_t i = 1; i < t.size() && tau > 0.0; ++i) phi[i] = std::min(std::exp((t[i - 1] - t[i]) / tau), kMost);
  return phi;
}

/// What is new in each value, in units of the process's deviation.
std::vector<double> whitened(const std::vector<double>& values, const std::vector<double>& phi) {
  std::vector<double> out = values;
  for (std::size_t i = 1; i < values.size(); ++i) {
    out[i] = (values[i] - phi[i] * values[i - 1]) / std::sqrt(1.0 - phi[i] * phi[i]);
  }
  return out;
}

/// Generalised least squares under one correlation: sums over pieces.
struct Judged {
  double log_determinants = 0.0;
  double freedom = 0.0;
  double xx = 0.0;  ///< squares of what is new in the deviations
  double xy = 0.0;
  double yy = 0.0;
  [[nodiscard]] double likelihood() const { return -log_determinants - freedom * std::log((xx + yy) / freedom); }
};

void judge(const Centred& in, const std::vector<double>& phi, Judged& sum) {
  const std::size_t n = in.t.size();
  const std::vector<double> one = whitened(std::vector<double>(n, 1.0), phi);
  const std::vector<double> t = whitened(in.t, phi);
  const double aa = dot(one, one);
  const double at = dot(one, t);
  const double tt = dot(t, t);
  const double determinant = aa * tt - at * at;
  const auto residual = [&](const std::vector<double>& values) {
    std::vector<double> w = whitened(values, phi);
    const double av = dot(one, w);
    const double tv = dot(t, w);
    const double level = (tt * av - at * tv) / determinant;
    const double slope = (aa * tv - at * av) / determinant;
    for (std::size_t i = 0; i < n; ++i) w[i] -= level * one[i] + slope * t[i];
    return w;
  };
  const std::vector<double> x = residual(in.x);
  const std::vector<double> y = residual(in.y);
  sum.freedom += static_cast<double>(n) - 2.0;
  sum.xx += dot(x, x);
  sum.xy += dot(x, y);
  sum.yy += dot(y, y);
  sum.log_determinants += std::log(determinant);
  for (const double p : phi) sum.log_determinants += std::log(1.0 - p * p);
}

/// Variance of the plain line's slope for deviations of variance 1.
double slope_variance(const Centred& in, const std::vector<double>& phi) {
  double sum = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < in.t.size(); ++i) {
    if (i > 0) before = phi[i] * (before + in.t[i - 1]);
    sum += in.t[i] * in.t[i] + 2.0 * in.t[i] * before;
  }
  return sum / (in.tt * in.tt);
}

Centred centred(const TimedPlaces& places) {
  Centred in{centred(places.t), centred(places.x), centred(places.y), 0.0};
  in.tt = dot(in.t, in.t);
  SONAR_CHECK(in.tt > 0.0);
  return in;
}

}  // namespace

Scatter common_scatter(std::span<const TimedPlaces> pieces) {
  SONAR_CHECK(!pieces.empty());
  std::vector<Centred> all;
  for (const TimedPlaces& piece : pieces) {
    SONAR_CHECK(piece.t.size() >= 3 && piece.x.size() == piece.t.size() && piece.y.size() == piece.t.size());
    all.push_back(centred(piece));
  }
  const double interval = median_interval(pieces);
  Scatter out;
  double best = 0.0;
  for (const double intervals : kIntervals) {
    Judged sum;
    for (const Centred& piece : all) judge(piece, correlations(piece.t, intervals * interval), sum);
    // Places that lie on the line to the last digit have no likelihood, and no error.
    // One residual tells of no correlation: likelihoods differ by rounding then, which decides nothing.
    if (intervals > 0.0 && !(sum.likelihood() > best + kGain)) continue;
    best = sum.likelihood();
    out = {intervals * interval, sum.xx / sum.freedom, sum.xy / sum.freedom, sum.yy / sum.freedom};
  }
  return out;
}

LineFit fit_line(const TimedPlaces& places, const Scatter& scatter) {
  const Centred in = centred(places);
  const double variance = slope_variance(in, correlations(in.t, scatter.tau_s));
  return {dot(in.t, in.x) / in.tt, dot(in.t, in.y) / in.tt, scatter.variance_xx * variance,
          scatter.variance_xy * variance, scatter.variance_yy * variance};
}

double covariance_with_slope(const std::vector<double>& t, double tau_s, std::size_t place) {
  SONAR_CHECK(place < t.size());
  const std::vector<double> off = centred(t);
  double sum = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double apart_s = std::abs(t[i] - t[place]);
    const double alike = i == place ? 1.0 : tau_s > 0.0 ? std::exp(-apart_s / tau_s) : 0.0;
    sum += off[i] * alike;
  }
  return sum / dot(off, off);
}

LineFit fit_line(const std::vector<double>& t, const std::vector<double>& x, const std::vector<double>& y) {
  const TimedPlaces places{t, x, y};
  return fit_line(places, common_scatter(std::span(&places, 1)));
}

}  // namespace sonar
