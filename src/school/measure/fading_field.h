// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "model/beam_grid.h"
#include "school/runs.h"

namespace sonar {

/// splitmix64 (Steele, Lea & Flood 2014): a number for each number, whatever the order they are asked in.
[[nodiscard]] std::uint64_t mixed(std::uint64_t x);

/// Fading of many targets' echo in a box of a ping: exponential, of mean 1, shared by neighbours as amplitude_correlation() and a
/// rectangular pulse tell. Between fans of one frequency as at the box's middle beam.
class FadingField {
 public:
  /// sample_m, pulse_m  as in voxels_alike()
  FadingField(const BeamGrid& grid, const IndexBox& box, double sample_m, double pulse_m);
  /// out     counts, of the box
  /// threads pure
  /// cost    about 10 ns a voxel
  [[nodiscard]] Array3<std::int16_t> draw(std::uint64_t seed) const;

 private:
  /// Lower triangle of weights that make independent amplitudes correlated ones, by row.
  using Weights = std::vector<std::vector<float>>;

  template <class Correlation>
  static Weights weights(int count, const Correlation& correlation);

  Shape3 size_;
  int pulse_samples_ = 1;
  std::vector<Weights> of_beams_;  ///< [fan]
  Weights of_fans_;
};

}  // namespace sonar
