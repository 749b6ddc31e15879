// SPDX-License-Identifier: Apache-2.0
#include "signal/elastic_sphere.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

/// Spherical Bessel functions of the orders 0 .. last at one argument, with their derivatives.
struct Bessel {
  std::vector<double> value, slope, curvature;

  /// From the values of one order more than is kept.
  Bessel(std::vector<double> f, double x) : value(std::move(f)) {
    for (std::size_t l = 0; l + 1 < value.size(); ++l) {
      const auto order = static_cast<double>(l);
      slope.push_back(order / x * value[l] - value[l + 1]);
      curvature.push_back((order * (order + 1.0) / (x * x) - 1.0) * value[l] - 2.0 / x * slope[l]);
    }
  }
};

/// First kind, downwards from an order at which it is nothing: upwards rounding takes over where order > x.
Bessel first_kind(int last, double x) {
  const int start = std::max(last, static_cast<int>(x)) + 40;
  std::vector<double> f(static_cast<std::size_t>(start) + 2);
  f[static_cast<std::size_t>(start)] = 1e-300;
  constexpr double kLarge = 1e200;
  for (int l = start; l > 0; --l) {
    const auto i = static_cast<std::size_t>(l);
    f[i - 1] = (2.0 * l + 1.0) / x * f[i] - f[i + 1];
    if (std::abs(f[i - 1]) < kLarge) continue;
    for (std::size_t k = i - 1; k < f.size(); ++k) f[k] /= kLarge;
  }
  // By the larger of the two orders that are known in closed form.
  const double zeroth = std::sin(x) / x;
  const double first = (zeroth - std::cos(x)) / x;
  const double scale = std::abs(zeroth) > std::abs(first) ? zeroth / f[0] : first / f[1];
  f.resize(static_cast<std::size_t>(last) + 2);
  for (double& value : f) value *= scale;
  return {std::move(f), x};
}

Bessel second_kind(int last, double x) {
  std::vector<double> f{-std::cos(x) / x, (-std::cos(x) / x - std::sin(x)) / x};
  for (int l = 1; l <= last; ++l) {
    const auto i = static_cast<std::size_t>(l);
    f.push_back((2.0 * l + 1.0) / x * f[i] - f[i - 1]);
  }
  return {std::move(f), x};
}

/// Backscattering cross-section, m^2. Symbols are MacLennan's.
double sigma_bs_m2(const CalibrationSphere& sphere, const WaterAround& water, double frequency_hz) {
  const double a = sphere.diameter_m / 2.0;
  const double c = water.sound_speed_mps;
  const double c1 = sphere.material.longitudinal_mps;
  const double c2 = sphere.material.transverse_mps;
  const double rho = sphere.material.density_kg_per_m3 / water.density_kg_per_m3;
  const double q = 2.0 * std::numbers::pi * frequency_hz / c * a;
  const double q1 = q * c / c1;
  const double q2 = q * c / c2;
  const double alpha = 2.0 * rho * (c2 / c) * (c2 / c);
  const double beta = rho * (c1 / c) * (c1 / c) - alpha;
  const int last = static_cast<int>(q) + 20;
  const Bessel j = first_kind(last, q);
  const Bessel y = second_kind(last, q);
  const Bessel j1 = first_kind(last, q1);
  const Bessel j2 = first_kind(last, q2);
  std::complex<double> sum;
  for (int order = 0; order <= last; ++order) {
    const auto l = static_cast<std::size_t>(order);
    const double ll = order * (order + 1.0);
    const double a1 = 2.0 * ll * (q1 * j1.slope[l] - j1.value[l]);
    const double a2 = (ll - 2.0) * j2.value[l] + q2 * q2 * j2.curvature[l];
    const double b1 = q * (a2 * q1 * j1.slope[l] - a1 * j2.value[l]);
    const double b2 =
        a2 * q1 * q1 * (beta * j1.value[l] - alpha * j1.curvature[l]) - a1 * alpha * (j2.value[l] - q2 * j2.slope[l]);
    const double above = b2 * j.slope[l] - b1 * j.value[l];
    const double below = b2 * y.slope[l] - b1 * y.value[l];
    const double eta = std::atan(-above / below);
    sum += (order % 2 == 0 ? 1.0 : -1.0) * (2.0 * order + 1.0) * std::sin(eta) * std::polar(1.0, eta);
  }
  return a * a / (q * q) * std::norm(sum);
}

}  // namespace

Result<CalibrationSphere> named_sphere(std::string_view name) {
  constexpr double kLeast_mm = 5.0;
  constexpr double kMost_mm = 200.0;
  std::string known;
  std::string lower(name);
  for (char& letter : lower) letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  for (const SphereMaterial& material : kSphereMaterials) {
    known += fmt::format("{}{} ({})", known.empty() ? "" : " or ", material.name, material.text);
    if (!lower.starts_with(material.name)) continue;
    double diameter_mm = 0.0;
    const char* end = lower.data() + lower.size();
    const auto [stop, error] = std::from_chars(lower.data() + material.name.size(), end, diameter_mm);
    if (error == std::errc{} && stop == end && diameter_mm >= kLeast_mm && diameter_mm <= kMost_mm) {
      return CalibrationSphere{material, diameter_mm * 1e-3};
    }
  }
  return fail(ErrorCode::bad_parameter,
              fmt::format("sphere '{}': expected a material, {}, and the diameter in mm, {} to {}, as in wc38.1", name,
                          known, kLeast_mm, kMost_mm));
}

double sea_water_density(const WaterProperties& water) {
  const double t = water.temperature_c;
  const double s = water.salinity_psu;
  const double root = std::sqrt(s);
  const double bar = water.depth_m * 0.100655;  // 1.0266 kg/l under 9.805 m/s^2
  const double pure =
      999.842594 + t * (6.793952e-2 + t * (-9.095290e-3 + t * (1.001685e-4 + t * (-1.120083e-6 + t * 6.536332e-9))));
  const double surface = pure +
                         s * (8.24493e-1 + t * (-4.0899e-3 + t * (7.6438e-5 + t * (-8.2467e-7 + t * 5.3875e-9)))) +
                         s * root * (-5.72466e-3 + t * (1.0227e-4 - t * 1.6546e-6)) + s * s * 4.8314e-4;
  const double pure_modulus = 19652.21 + t * (148.4206 + t * (-2.327105 + t * (1.360477e-2 - t * 5.155288e-5)));
  const double modulus = pure_modulus + s * (54.6746 + t * (-0.603459 + t * (1.09987e-2 - t * 6.1670e-5))) +
                         s * root * (7.944e-2 + t * (1.6483e-2 - t * 5.3009e-4));
  const double linear = 3.239908 + t * (1.43713e-3 + t * (1.16092e-4 - t * 5.77905e-7)) +
                        s * (2.2838e-3 + t * (-1.0981e-5 - t * 1.6078e-6)) + s * root * 1.91075e-4;
  const double square =
      8.50935e-5 + t * (-6.12293e-6 + t * 5.2787e-8) + s * (-9.9348e-7 + t * (2.0816e-8 + t * 9.1697e-10));
  return surface / (1.0 - bar / (modulus + bar * (linear + bar * square)));
}

double sphere_ts_db(const CalibrationSphere& sphere, const WaterAround& water, double frequency_hz) {
  return db_from_linear(sigma_bs_m2(sphere, water, frequency_hz));
}

double sphere_ts_db(const CalibrationSphere& sphere, const WaterAround& water, double frequency_hz,
                    double pulse_length_s) {
  // To the second null on either side, where the weights are below 3e-3.
  constexpr int kSteps = 40;
  double sum = 0.0;
  double weights = 0.0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const double x = 2.0 * std::numbers::pi * i / kSteps;
    const double sinc = i == 0 ? 1.0 : std::sin(x) / x;
    const double weight = sinc * sinc * sinc * sinc;
    sum += weight * sigma_bs_m2(sphere, water, frequency_hz + x / (std::numbers::pi * pulse_length_s));
    weights += weight;
  }
  return db_from_linear(sum / weights);
}

}  // namespace sonar
