// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace sonar::synth::array {

/// What the receiver makes of a point's echo: the transmitted envelope (edges of a raised cosine) through its own
/// matched filter, 1 at the peak.
class Pulse {
 public:
  static constexpr int kTaps = 8;
  using Taps = std::array<float, kTaps>;

  /// taper  share of the pulse in its rise and fall, 0..1
  Pulse(double length_s, double sample_interval_s, double taper);

  /// Amplitude at a time from the peak; symmetric.
  [[nodiscard]] double amplitude(double offset_s) const;
  /// Integral of the squared envelope: what takes the place of the pulse's length in echo integration.
  [[nodiscard]] double effective_s() const { return effective_s_; }
  /// Amplitudes at the samples first_tap(peak) + 0 .. kTaps - 1 around a peak at a fractional sample.
  [[nodiscard]] const Taps& taps(double peak_sample) const;
  [[nodiscard]] static int first_tap(double peak_sample);
  /// The filter's own taps with their squares' sum at 1: noise goes through them and keeps its power.
  [[nodiscard]] const Taps& noise_taps() const { return noise_; }

 private:
  double step_s_;
  double effective_s_ = 0.0;
  std::vector<double> amplitude_;  ///< at multiples of step_s_ from the peak
  std::vector<Taps> phases_;
  Taps noise_{};
};

}  // namespace sonar::synth::array
