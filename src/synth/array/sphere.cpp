// SPDX-License-Identifier: Apache-2.0
#include "synth/array/sphere.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/units.h"
#include "synth/beam_table.h"
#include "synth/random.h"

namespace sonar::synth::array {
namespace {

constexpr double kWater_kg_per_m3 = 1027.5;

struct Solid {
  double density, longitudinal_mps, transverse_mps;
};
/// Tungsten carbide with 6 % cobalt, electrical-grade copper.
constexpr std::array<Solid, 2> kSolids = {{{14900.0, 6853.0, 4171.0}, {8947.0, 4760.0, 2288.5}}};

/// x j'(x) / j(x) of the spherical Bessel function of an order, by the continued fraction of j(n + 1) / j(n).
double log_slope(int order, double x) {
  double ratio = 0.0;
  for (int n = order + 60 + static_cast<int>(x); n > order; --n) ratio = 1.0 / ((2.0 * n + 1.0) / x - ratio);
  return order - x * ratio;
}

/// tan of Faran's angle zeta, times the ratio of densities that makes Phi of it.
double boundary(int n, double x1, double x2, double density_ratio) {
  const double alpha1 = -log_slope(n, x1);
  const double alpha2 = -log_slope(n, x2);
  const double nn = n * (n + 1.0);
  const double half = x2 * x2 / 2.0;
  const double first = alpha1 / (alpha1 + 1.0);
  const double second = nn / (nn - 1.0 - half + alpha2);
  const double third = (nn - half + 2.0 * alpha1) / (alpha1 + 1.0);
  const double fourth = nn * (alpha2 + 1.0) / (nn - 1.0 - half + alpha2);
  const double zeta = -half * (first - second) / (third - fourth);
  return -density_ratio * zeta;
}

}  // namespace

double sphere_amplitude_m(const SphereParams& params, double frequency_hz) {
  const Solid& solid = kSolids[static_cast<std::size_t>(params.material)];
  const double wave = 2.0 * std::numbers::pi * frequency_hz;
  const double radius = params.diameter_mm * 0.5e-3;
  const double x = wave / kSoundSpeed_mps * radius;
  const double x1 = wave / solid.longitudinal_mps * radius;
  const double x2 = wave / solid.transverse_mps * radius;
  // Second kind upwards, first kind from the ratio of neighbours and Wronski's determinant: j(n) y(n-1) - j(n-1) y(n) = x^-2.
  double y_before = -std::cos(x) / x;
  double y_now = y_before / x - std::sin(x) / x;
  std::complex<double> sum;
  const int last = static_cast<int>(x) + 20;
  for (int n = 0; n <= last; ++n) {
    const double y = n == 0 ? y_before : y_now;
    const double y_next = n == 0 ? y_now : (2.0 * n + 1.0) / x * y_now - y_before;
    const double slope = log_slope(n, x);
    const double next_share = (n - slope) / x;  // j(n + 1) / j(n)
    const double j = 1.0 / (x * x * (next_share * y - y_next));
    const double alpha = -slope;
    const double beta = -(n - x * y_next / y);
    const double phi = boundary(n, x1, x2, kWater_kg_per_m3 / solid.density);
    const double eta = std::atan(-j / y * (phi + alpha) / (phi + beta));
    sum += (n % 2 == 0 ? 1.0 : -1.0) * (2.0 * n + 1.0) * std::sin(eta) * std::polar(1.0, eta);
    if (n > 0) y_before = y_now;
    y_now = y_next;
    if (n == 0) y_before = y;
  }
  return std::abs(sum) * kSoundSpeed_mps / wave;
}

double sphere_amplitude_m(const SphereParams& params, double frequency_hz, const Pulse& pulse, double pulse_length_s) {
  constexpr int kFrequencies = 60;  // on either side, up to 3 / pulse length
  constexpr int kTimes = 400;
  double sum = 0.0;
  double weights = 0.0;
  for (int i = -kFrequencies; i <= kFrequencies; ++i) {
    const double off_hz = 3.0 / pulse_length_s * i / kFrequencies;
    double spectrum = 0.0;
    for (int t = -kTimes; t <= kTimes; ++t) {
      const double at_s = pulse_length_s * t / kTimes;
      spectrum += pulse.amplitude(at_s) * std::cos(2.0 * std::numbers::pi * off_hz * at_s);
    }
    const double weight = spectrum * spectrum;
    sum += weight * std::pow(sphere_amplitude_m(params, frequency_hz + off_hz), 2);
    weights += weight;
  }
  return std::sqrt(sum / weights);
}

std::vector<double> sphere_amplitudes_m(const SphereParams& params, const Receiver& receiver) {
  std::vector<double> amplitudes;
  for (const Fan& fan : receiver.pattern().fans()) {
    amplitudes.push_back(sphere_amplitude_m(params, fan.frequency_hz, receiver.pulse(), kPulseLength_s));
  }
  return amplitudes;
}

SphereTruth sphere_at(const SphereParams& p, int ping, int pings, std::uint64_t seed) {
  constexpr double kSwing_deg = 0.3;
  constexpr double kSwing_m = 1.5;
  RandomStream random(seed, Purpose::sphere);
  const double high = p.elevation_to_deg - p.elevation_from_deg;
  const double wide = p.azimuth_to_deg - p.azimuth_from_deg;
  // As far from line to line as from ping to ping.
  const int lines = std::max(1, static_cast<int>(std::lround(std::sqrt(pings * high / std::max(1e-3, wide)))));
  const double way = (ping + 0.5) / pings * lines;
  const int line = static_cast<int>(way);
  const double along = line % 2 == 0 ? way - line : 1.0 - (way - line);
  const auto swing = [&](double size) {
    double sum = 0.0;
    for (const double period : {5.3, 11.9, 37.0}) {
      sum += std::sin(2.0 * std::numbers::pi * (ping / period + random.uniform())) / 2.0;
    }
    return size * sum;
  };
  SphereTruth at;
  at.ping_index = ping;
  at.elevation_deg = p.elevation_from_deg + high * (line + 0.5) / lines + swing(kSwing_deg);
  at.azimuth_deg = p.azimuth_from_deg + wide * along + swing(kSwing_deg);
  at.range_m = p.range_m + swing(kSwing_m);
  return at;
}

Point<Enu> place_of(const SphereTruth& sphere, const View& view) {
  const Direction d = direction(rad_from_deg(sphere.elevation_deg), rad_from_deg(sphere.azimuth_deg));
  return view.from_ship(d.bow * sphere.range_m, d.abeam * sphere.range_m, d.up * sphere.range_m);
}

}  // namespace sonar::synth::array
