// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/result.h"
#include "signal/absorption.h"

namespace sonar {

/// A solid that calibration spheres are made of.
struct SphereMaterial {
  std::string_view name;  ///< as in "wc38.1", lower case
  std::string_view text;
  double density_kg_per_m3 = 0.0;
  double longitudinal_mps = 0.0;  ///< speed of compressional waves
  double transverse_mps = 0.0;    ///< speed of shear waves
  std::string_view source;
};

inline constexpr std::array<SphereMaterial, 2> kSphereMaterials{
    {{"wc", "tungsten carbide with 6 % cobalt", 14900.0, 6853.0, 4171.0,
      "MacLennan & Dunn 1984; Foote & MacLennan, J. Acoust. Soc. Am. 75 (1984) 612"},
     {"cu", "electrical-grade copper", 8947.0, 4760.0, 2288.5, "Foote, J. Acoust. Soc. Am. 73 (1983) 1054"}}};

struct CalibrationSphere {
  SphereMaterial material;
  double diameter_m = 0.0;
};

/// "wc38.1", "Cu60": a material of kSphereMaterials and the diameter in mm, 5 to 200.
/// errors  bad_parameter
[[nodiscard]] Result<CalibrationSphere> named_sphere(std::string_view name);

/// The water around a sphere.
struct WaterAround {
  double sound_speed_mps = 0.0;
  double density_kg_per_m3 = 0.0;
};

/// Density of sea water, kg/m^3; 0..40 deg C, 0..42 psu, to 10 000 m.
/// source  UNESCO equation of state 1980: Fofonoff & Millard, UNESCO technical papers in marine science 44 (1983). Check
///         values: 35 psu, 5 deg C: 1027.675 at the surface, 1069.489 under 1000 bar
[[nodiscard]] double sea_water_density(const WaterProperties& water);

/// Target strength of an elastic sphere for one frequency, dB re 1 m^2: the exact series over partial waves.
/// source  MacLennan, The theory of solid spheres as sonar calibration targets, Scottish Fisheries Research Report 22
///         (1981), equations 6 to 9
[[nodiscard]] double sphere_ts_db(const CalibrationSphere& sphere, const WaterAround& water, double frequency_hz);

/// The same for a pulse: backscattering cross-sections averaged over the band of a rectangular pulse that passes a
/// receiver matched to it, weights sinc^4(pi (f - f0) tau). Near a null of the series this differs from the above.
/// source  Foote, Maintaining precision calibrations with optimal copper spheres, J. Acoust. Soc. Am. 73 (1983) 1054
[[nodiscard]] double sphere_ts_db(const CalibrationSphere& sphere, const WaterAround& water, double frequency_hz,
                                  double pulse_length_s);

}  // namespace sonar
