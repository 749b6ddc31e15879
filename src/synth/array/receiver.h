// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "base/array.h"
#include "geo/sector.h"
#include "model/product.h"
#include "synth/array/pattern.h"
#include "synth/array/pulse.h"
#include "synth/truth.h"

namespace sonar::synth::array {

/// One echo on its way back: a fish, a bubble, or many in one place.
struct Echo {
  Direction from;
  double range_m = 0.0;
  std::complex<double> amplitude;    ///< m, of size sqrt(sigma_bs); its phase beside that of the way
  double expected_m2 = 0.0;          ///< mean of its squared size
  std::span<const double> of_fan{};  ///< [fan] what its amplitude is at the fan's frequency, times the above; empty = 1
};

/// Expected power over transmitted geometry: a part of the grid in which W accumulate.
struct ExpectedBox {
  int first_sample = 0;
  Array3<float> power_w;  ///< [fan][beam][sample from first_sample]
};

/// The sonar of all beams: the point-target equation from echo to sample.
///   P = Pt G^2 (lambda / 4 pi)^2 b sigma_bs 10^(-2 alpha r / 10) / r^4
/// with b the true two-way pattern, 1 on the beam's axis.
/// source  Simrad ER60 manual; MacLennan and Simmonds 2005, equation 3.10
class Receiver {
 public:
  /// beams  what the table says; of it gain, power and absorption are true
  Receiver(const Pattern& pattern, const Pulse& pulse, std::vector<Beam> beams);

  [[nodiscard]] const Pattern& pattern() const { return pattern_; }
  [[nodiscard]] const Pulse& pulse() const { return pulse_; }
  [[nodiscard]] const std::vector<Beam>& beams() const { return beams_; }
  [[nodiscard]] const RangeAxis& range() const { return range_; }
  [[nodiscard]] Shape3 shape() const { return shape_; }
  [[nodiscard]] const Beam& beam(int fan, int beam) const;
  /// Received power of an on-axis target of 1 m^2 at 1 m without absorption, W.
  [[nodiscard]] double constant_w(int fan, int beam) const;
  /// Power over sv in a sample: the integral of the point-target equation over a homogeneous volume.
  [[nodiscard]] double power_per_sv(int fan, int beam, int sample) const;

  /// Adds the echo to every beam that hears it.
  /// field     [fan][beam][sample], square root of W; may be empty (no shape): none wanted
  /// expected  power; its box may be smaller than the grid; null: none wanted
  void add(const Echo& echo, View3<std::complex<float>> field, ExpectedBox* expected) const;

 private:
  const Pattern& pattern_;
  const Pulse& pulse_;
  std::vector<Beam> beams_;
  RangeAxis range_;
  Shape3 shape_;
  std::vector<float> root_w_;  ///< [fan][beam], square root of constant_w
};

}  // namespace sonar::synth::array
