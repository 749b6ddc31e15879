// SPDX-License-Identifier: Apache-2.0
#include "school/measure/vertical_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace sonar {
namespace {

// Numbers of the arithmetic (nodes and steps until nothing moves any more) and of the ellipsoid, no choices.
constexpr int kNodes = 9;
constexpr double kMarginalVariance = 0.2;  ///< of an ellipsoid's marginal 1 - u^2 on -1..1
constexpr int kScoringSteps = 6;
constexpr double kFirstHalfHeight_m = 0.25;
constexpr double kGrowth = 1.1;
constexpr std::size_t kMostHeights = 64;  // more than 1 km

/// Quadrature of the marginal 3/4 (1 - u^2): u and weight, scaled so that the variance is exact.
struct Marginal {
  std::array<double, kNodes> u{};
  std::array<double, kNodes> weight{};
  Marginal() {
    double sum = 0.0;
    double square = 0.0;
    for (std::size_t k = 0; k < kNodes; ++k) {
      u[k] = (2.0 * static_cast<double>(k) + 1.0) / kNodes - 1.0;
      weight[k] = 1.0 - u[k] * u[k];
      sum += weight[k];
      square += weight[k] * u[k] * u[k];
    }
    const double scale = std::sqrt(kMarginalVariance * sum / square);
    for (std::size_t k = 0; k < kNodes; ++k) {
      weight[k] /= sum;
      u[k] *= scale;
    }
  }
};

/// A two-way pattern and its derivative by the angle, in units of the Gaussian's standard deviation.
struct PatternAt {
  double value = 0.0;
  double slope = 0.0;
};

/// sin(x)/x falls to a half in power at this x.
constexpr double kHalfPowerOfSinc = 1.3915573782515105;

/// Receiving and transmitting beam, the latter's angle shrunk by q.
PatternAt gaussian(double z, double q) {
  const double steepness = 0.5 * (1.0 + q * q);
  const double value = std::exp(-0.5 * steepness * z * z);
  return {value, -steepness * z * value};
}

/// (sin x / x)^2.
PatternAt line_one_way(double x) {
  constexpr double kSmall = 1e-4;  // below it the quotient loses its digits, and the parabola is exact to 1e-16
  if (std::abs(x) < kSmall) return {1.0 - x * x / 3.0, -2.0 * x / 3.0};
  const double s = std::sin(x) / x;
  return {s * s, 2.0 * s * (std::cos(x) - s) / x};
}

/// (sin x / x)^2 (sin qx / qx)^2, of one -3 dB width with the Gaussian.
PatternAt uniform_line(double z, double q) {
  const double scale = kHalfPowerOfSinc / (2.0 * std::sqrt(std::numbers::ln2));
  const double x = z * scale;
  if (q != 1.0) {
    const PatternAt receive = line_one_way(x);
    const PatternAt transmit = line_one_way(q * x);
    return {receive.value * transmit.value,
            (receive.slope * transmit.value + receive.value * transmit.slope * q) * scale};
  }
  constexpr double kSmall = 1e-4;  // below it the quotient loses its digits, and the parabola is exact to 1e-16
  if (std::abs(x) < kSmall) return {1.0 - 2.0 * x * x / 3.0, -4.0 * x / 3.0 * scale};
  const double s = std::sin(x) / x;
  return {s * s * s * s, 4.0 * s * s * s * (std::cos(x) - s) / x * scale};
}

PatternAt pattern_at(double gaussian_share, double transmit_ratio, double z) {
  const PatternAt g = gaussian_share > 0.0 ? gaussian(z, transmit_ratio) : PatternAt{};
  const PatternAt u = gaussian_share < 1.0 ? uniform_line(z, transmit_ratio) : PatternAt{};
  const double rest = 1.0 - gaussian_share;
  return {gaussian_share * g.value + rest * u.value, gaussian_share * g.slope + rest * u.slope};
}

class Likelihood {
 public:
  Likelihood(const std::vector<FanEcho>& fans, const BeamModel& beam)
      : fans_(fans),
        gaussian_share_(beam.gaussian_share),
        transmit_ratio_(beam.transmit_ratio),
        pedestal_(beam.pedestal) {
    double sum = 0.0;
    double moment = 0.0;
    for (const FanEcho& fan : fans) {
      const double body = std::max(fan.echo - fan.background, 0.0);
      sum += body;
      moment += body * fan.elevation_rad;
      strongest_ = std::max(strongest_, body);
    }
    centre_ = sum > 0.0 ? moment / sum : 0.0;
    amplitude_ = strongest_ * fans.front().sigma_rad;
  }

  /// Best log-likelihood for a half height (rad); moves centre and amplitude there.
  double best(double half_height) {
    for (int step = 0; step < kScoringSteps; ++step) score(half_height);
    return value(half_height);
  }
  [[nodiscard]] double centre() const { return centre_; }
  [[nodiscard]] bool sound() const { return strongest_ > 0.0 && std::isfinite(centre_) && std::isfinite(amplitude_); }

 private:
  /// Beam-blurred marginal at a fan and its derivative by the centre.
  void model(const FanEcho& fan, double half_height, double& m, double& dm) const {
    m = 0.0;
    dm = 0.0;
    const double inverse = 1.0 / fan.sigma_rad;
    for (std::size_t k = 0; k < kNodes; ++k) {
      const double z = (fan.elevation_rad - centre_ - half_height * marginal_.u[k]) * inverse;
      const PatternAt p = pattern_at(gaussian_share_, transmit_ratio_, z);
      m += marginal_.weight[k] * p.value * inverse;
      dm -= marginal_.weight[k] * p.slope * inverse * inverse;
    }
  }

  /// One step of Fisher scoring in (ln amplitude, centre).
  void score(double half_height) {
    double i_aa = 0.0;
    double i_ac = 0.0;
    double i_cc = 0.0;
    double s_a = 0.0;
    double s_c = 0.0;
    for (const FanEcho& fan : fans_) {
      double m = 0.0;
      double dm = 0.0;
      model(fan, half_height, m, dm);
      const double expected = amplitude_ * m + fan.background + pedestal_ * strongest_;
      const double da = amplitude_ * m / expected;
      const double dc = amplitude_ * dm / expected;
      const double off = (fan.echo + pedestal_ * strongest_) / expected - 1.0;
      s_a += fan.looks * off * da;
      s_c += fan.looks * off * dc;
      i_aa += fan.looks * da * da;
      i_ac += fan.looks * da * dc;
      i_cc += fan.looks * dc * dc;
    }
    const double determinant = i_aa * i_cc - i_ac * i_ac;
    if (!(determinant > 0.0)) return;
    const double a = (i_cc * s_a - i_ac * s_c) / determinant;
    const double c = (i_aa * s_c - i_ac * s_a) / determinant;
    const double widest = fans_.front().sigma_rad;
    amplitude_ *= std::exp(std::clamp(a, -1.0, 1.0));
    centre_ += std::clamp(c, -widest, widest);
  }

  [[nodiscard]] double value(double half_height) const {
    double sum = 0.0;
    for (const FanEcho& fan : fans_) {
      double m = 0.0;
      double dm = 0.0;
      model(fan, half_height, m, dm);
      const double expected = amplitude_ * m + fan.background + pedestal_ * strongest_;
      const double ratio = (fan.echo + pedestal_ * strongest_) / expected;
      sum -= fan.looks * (ratio - 1.0 - std::log(ratio));
    }
    return sum;
  }

  const std::vector<FanEcho>& fans_;
  double gaussian_share_;
  double transmit_ratio_;
  double pedestal_;
  Marginal marginal_;
  double centre_ = 0.0;
  double amplitude_ = 0.0;
  double strongest_ = 0.0;
};

}  // namespace

double two_way_pattern(const BeamModel& beam, double off_axis) {
  return pattern_at(beam.gaussian_share, beam.transmit_ratio, off_axis).value;
}

double half_height_m(std::size_t k) {
  return kFirstHalfHeight_m * (std::pow(kGrowth, static_cast<double>(k)) - 1.0) / (kGrowth - 1.0);
}

double HeightLikelihood::overdispersion() const {
  if (at.empty() || freedom < 2) return 1.0;
  return std::max(1.0, -2.0 * *std::max_element(at.begin(), at.end()) / (freedom - 1));
}

HeightLikelihood height_likelihood(const std::vector<FanEcho>& fans, const BeamModel& beam, double range_m) {
  if (fans.size() < 3 || !(range_m > 0.0)) return {};
  HeightLikelihood heights;
  heights.freedom = static_cast<int>(fans.size()) - 2;
  Likelihood likelihood(fans, beam);
  const double span = std::abs(fans.back().elevation_rad - fans.front().elevation_rad);
  for (std::size_t k = 0; k < kMostHeights && half_height_m(k) <= range_m * span; ++k) {
    if (!likelihood.sound()) return {};
    heights.at.push_back(likelihood.best(half_height_m(k) / range_m));
  }
  if (!likelihood.sound()) return {};
  return heights;
}

void add_sighting(HeightLikelihood& sum, const HeightLikelihood& more, double dispersion) {
  if (more.at.empty()) return;
  if (sum.at.empty()) sum.at.assign(more.at.size(), 0.0);
  sum.at.resize(std::min(sum.at.size(), more.at.size()));
  for (std::size_t k = 0; k < sum.at.size(); ++k) sum.at[k] += more.at[k] / dispersion;
  sum.freedom += more.freedom;
}

std::optional<LikelyHeight> most_likely_height(const HeightLikelihood& heights) {
  const std::vector<double>& at = heights.at;
  if (at.empty()) return std::nullopt;
  const auto peak = static_cast<std::size_t>(std::max_element(at.begin(), at.end()) - at.begin());
  double place = static_cast<double>(peak);
  double most = at[peak];
  if (peak > 0 && peak + 1 < at.size()) {
    const double rise = at[peak + 1] - at[peak - 1];
    const double bend = 2.0 * at[peak] - at[peak - 1] - at[peak + 1];
    if (bend > 0.0) {
      place += 0.5 * rise / bend;
      most += rise * rise / (8.0 * bend);
    }
  }
  const double half = kFirstHalfHeight_m * (std::pow(kGrowth, place) - 1.0) / (kGrowth - 1.0);
  const double evidence = (most - at.front()) / heights.overdispersion();
  return LikelyHeight{half * half * kMarginalVariance, std::max(evidence, 0.0)};
}

}  // namespace sonar
