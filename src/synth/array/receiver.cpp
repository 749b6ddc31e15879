// SPDX-License-Identifier: Apache-2.0
#include "synth/array/receiver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar::synth::array {
namespace {

/// Two-way amplitudes below these are left out: -70 dB of an echo, -45 dB of an expectation.
constexpr double kLeastHeard = 3.2e-4;
constexpr float kLeastExpected = 3.2e-5F;  ///< squared
constexpr double kNearest_m = 1.0;
constexpr std::size_t kMostBeams = 128;

}  // namespace

Receiver::Receiver(const Pattern& pattern, const Pulse& pulse, std::vector<Beam> beams)
    : pattern_(pattern), pulse_(pulse), beams_(std::move(beams)) {
  int samples = 0;
  for (const Beam& beam : beams_) samples = std::max(samples, beam.count);
  range_ = {-kSoundSpeed_mps * kPulseLength_s / 4.0, kSoundSpeed_mps * kSampleInterval_s / 2.0, samples};
  shape_ = {static_cast<int>(pattern.fans().size()), static_cast<int>(pattern.fans().front().channel.size()), samples};
  for (int f = 0; f < shape_.fans; ++f) {
    for (int b = 0; b < shape_.beams; ++b) root_w_.push_back(static_cast<float>(std::sqrt(constant_w(f, b))));
  }
}

const Beam& Receiver::beam(int fan, int beam) const {
  const int channel = pattern_.fans()[static_cast<std::size_t>(fan)].channel[static_cast<std::size_t>(beam)];
  return beams_[static_cast<std::size_t>(channel)];
}

double Receiver::constant_w(int fan, int b) const {
  const Beam& table = beam(fan, b);
  const double wavelength = kSoundSpeed_mps / table.frequency_hz;
  const double gain = linear_from_db(table.gain_db);
  return table.power_w * std::pow(gain * wavelength / (4.0 * std::numbers::pi), 2);
}

double Receiver::power_per_sv(int fan, int b, int sample) const {
  const double r = std::max(kNearest_m, range_.range_m(sample));
  const Beam& table = beam(fan, b);
  const int channel = pattern_.fans()[static_cast<std::size_t>(fan)].channel[static_cast<std::size_t>(b)];
  const double pulse_m = kSoundSpeed_mps * pulse_.effective_s() / 2.0;
  return constant_w(fan, b) * pattern_.psi_sr(channel) * pulse_m *
         std::pow(10.0, -0.2 * table.absorption_db_per_m * r) / (r * r);
}

void Receiver::add(const Echo& echo, View3<std::complex<float>> field, ExpectedBox* expected) const {
  if (echo.range_m < kNearest_m || echo.from.abeam <= 0.0) return;
  const double peak = range_.sample_at(echo.range_m);
  const int first = Pulse::first_tap(peak);
  if (first < 0 || first + Pulse::kTaps > shape_.samples) return;
  const Pulse::Taps& taps = pulse_.taps(peak);
  const bool listens = field.shape().size() > 0;
  std::array<std::complex<float>, kMostBeams> amplitude;
  const double spread = 1.0 / (echo.range_m * echo.range_m);
  for (int f = 0; f < shape_.fans; ++f) {
    const Fan& fan = pattern_.fans()[static_cast<std::size_t>(f)];
    if (!pattern_.two_way(f, echo.from, kLeastHeard, {amplitude.data(), fan.bow.size()})) continue;
    const double of_fan = echo.of_fan.empty() ? 1.0 : echo.of_fan[static_cast<std::size_t>(f)];
    const double lost = of_fan * spread * std::pow(10.0, -0.1 * beam(f, 0).absorption_db_per_m * echo.range_m);
    const double way = std::remainder(2.0 * fan.wave_number * echo.range_m, 2.0 * std::numbers::pi);
    const std::complex<float> arrives(echo.amplitude * std::polar(lost, way));
    const auto mean = static_cast<float>(echo.expected_m2 * lost * lost);
    for (int b = 0; b < shape_.beams; ++b) {
      const float root = root_w_[static_cast<std::size_t>(f * shape_.beams + b)];
      const std::complex<float> heard = amplitude[static_cast<std::size_t>(b)];
      if (listens) {
        const float re = root * (heard.real() * arrives.real() - heard.imag() * arrives.imag());
        const float im = root * (heard.real() * arrives.imag() + heard.imag() * arrives.real());
        auto* to = reinterpret_cast<float*>(field.row(f, b).data() + first);  // complex is two floats by the standard
        for (std::size_t t = 0; t < Pulse::kTaps; ++t) {
          to[2 * t] += re * taps[t];
          to[2 * t + 1] += im * taps[t];
        }
      }
      const float power = std::norm(heard);
      if (expected == nullptr || power < kLeastExpected) continue;
      const auto to = expected->power_w.row(f, b);
      const int at = first - expected->first_sample;
      if (at < 0 || at + Pulse::kTaps > static_cast<int>(to.size())) continue;
      const float watts = root * root * power * mean;
      for (std::size_t t = 0; t < Pulse::kTaps; ++t) to[static_cast<std::size_t>(at) + t] += watts * taps[t] * taps[t];
    }
  }
}

}  // namespace sonar::synth::array
