// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <vector>

#include "synth/array/company.h"
#include "synth/array/receiver.h"

namespace sonar::synth::array {

/// Samples of a fan in which one kind of the diffuse echo is the strongest.
struct DiffuseStretch {
  CompanyKind kind;
  int fan, first_sample, last_sample;
};

/// Echoes of what has more scatterers than could be summed: the water, layers, the surface, the seabed, and the noise.
/// Each range and bearing holds a complex Gaussian amplitude, as a sum over very many scatterers is; a fan's beams hear
/// the same amplitudes through their own patterns, so that neighbouring beams agree as far as they overlap. The vertical
/// pattern is taken where the horizontal one is on its axis and the other way round; a beam's whole is held to psi.
class Diffuse {
 public:
  Diffuse(const Receiver& receiver, const Sea& sea, double transducer_depth_m, std::uint64_t seed);

  struct Heard {
    Array3<float> expected_w;  ///< [fan][beam][sample], noise included
    std::vector<DiffuseStretch> stretches;
  };
  /// Adds amplitudes (square root of W) and tells what was expected.
  Heard add(const View& view, std::uint32_t observation, int ping, View3<std::complex<float>> field) const;

 private:
  struct Surfaces;
  struct Densities;
  void fill_patterns();
  void fill_profiles(double transducer_depth_m);
  [[nodiscard]] float vertical(std::size_t fan, double elevation_rad) const;
  [[nodiscard]] Surfaces look_around(const View& view) const;
  void fill_densities(const Surfaces& around, int fan, Densities& out) const;
  void hear_fan(const Densities& densities, int fan, std::uint32_t observation, int ping,
                View3<std::complex<float>> field, Array3<float>& expected) const;

  const Receiver& receiver_;
  const Sea& sea_;
  std::uint64_t seed_;
  std::vector<std::vector<float>> vertical_;                  ///< [fan][elevation], two-way power, 1 on the axis
  std::vector<std::vector<std::complex<float>>> horizontal_;  ///< [fan][beam][azimuth], 1 on the axis
  std::vector<float> held_to_psi_;                            ///< [fan][beam]
  std::vector<std::vector<float>> volume_;                    ///< [fan][sample], m^-1 rad
  std::vector<std::vector<std::vector<float>>> layers_;       ///< [layer][fan][sample]
  std::vector<float> noise_w_;                                ///< [fan][beam]
  Array3<float> power_per_sv_sr_;                             ///< [fan][beam][sample]: W m for 1 sr
};

}  // namespace sonar::synth::array
