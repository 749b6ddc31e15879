// SPDX-License-Identifier: Apache-2.0
#include "synth/array/pulse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sonar::synth::array {
namespace {

constexpr int kSteps = 1024;  ///< in a pulse
constexpr int kPhases = 64;   ///< in a sample
constexpr int kBefore = Pulse::kTaps / 2 - 1;

/// Envelope at x of 0..1 along the pulse.
double envelope(double x, double taper) {
  const double edge = taper / 2.0;
  const double inside = std::min(x, 1.0 - x);
  if (inside < 0.0) return 0.0;
  if (inside >= edge) return 1.0;
  return 0.5 * (1.0 - std::cos(std::numbers::pi * inside / edge));
}

}  // namespace

Pulse::Pulse(double length_s, double sample_interval_s, double taper)
    : step_s_(length_s / kSteps), amplitude_(kSteps + 1) {
  std::vector<double> sent(kSteps);
  for (int i = 0; i < kSteps; ++i) sent[static_cast<std::size_t>(i)] = envelope((i + 0.5) / kSteps, taper);
  for (std::size_t lag = 0; lag <= kSteps; ++lag) {
    for (std::size_t i = lag; i < kSteps; ++i) amplitude_[lag] += sent[i] * sent[i - lag];
  }
  const double peak = amplitude_[0];
  for (double& a : amplitude_) a /= peak;
  for (std::size_t i = 0; i < kSteps; ++i) {
    effective_s_ += step_s_ * (amplitude_[i] * amplitude_[i] + amplitude_[i + 1] * amplitude_[i + 1]);
  }
  for (int phase = 0; phase < kPhases; ++phase) {
    const double fraction = (phase + 0.5) / kPhases;
    Taps& taps = phases_.emplace_back();
    for (int t = 0; t < kTaps; ++t) {
      taps[static_cast<std::size_t>(t)] = static_cast<float>(amplitude((t - kBefore - fraction) * sample_interval_s));
    }
  }
  double sum = 0.0;
  for (int t = 0; t < kTaps; ++t) {
    const double a = amplitude((t - kBefore) * sample_interval_s);
    noise_[static_cast<std::size_t>(t)] = static_cast<float>(a);
    sum += a * a;
  }
  for (float& a : noise_) a = static_cast<float>(static_cast<double>(a) / std::sqrt(sum));
}

double Pulse::amplitude(double offset_s) const {
  const double x = std::abs(offset_s) / step_s_;
  const auto i = static_cast<std::size_t>(x);
  if (i + 1 >= amplitude_.size()) return 0.0;
  const double part = x - static_cast<double>(i);
  return amplitude_[i] * (1.0 - part) + amplitude_[i + 1] * part;
}

int Pulse::first_tap(double peak_sample) { return static_cast<int>(std::floor(peak_sample)) - kBefore; }

const Pulse::Taps& Pulse::taps(double peak_sample) const {
  const double fraction = peak_sample - std::floor(peak_sample);
  return phases_[static_cast<std::size_t>(std::min(kPhases - 1, static_cast<int>(fraction * kPhases)))];
}

}  // namespace sonar::synth::array
