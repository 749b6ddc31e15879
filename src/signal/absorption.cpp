// SPDX-License-Identifier: Apache-2.0
#include "signal/absorption.h"

#include <cmath>

namespace sonar {

namespace {

/// One relaxation: f^2 fr / (f^2 + fr^2), in kHz.
double relaxation(double f_khz, double relaxation_khz) {
  return relaxation_khz * f_khz * f_khz / (relaxation_khz * relaxation_khz + f_khz * f_khz);
}

}  // namespace

double absorption_francois_garrison(double frequency_hz, const WaterProperties& water, double sound_speed_mps) {
  const double f = frequency_hz * 1e-3;
  const double t = water.temperature_c;
  const double s = water.salinity_psu;
  const double d = water.depth_m;
  const double kelvin = 273.0 + t;
  const double c = sound_speed_mps > 0.0 ? sound_speed_mps : 1412.0 + 3.21 * t + 1.19 * s + 0.0167 * d;

  const double boric = 8.86 / c * std::pow(10.0, 0.78 * water.ph - 5.0);
  const double boric_khz = 2.8 * std::sqrt(s / 35.0) * std::pow(10.0, 4.0 - 1245.0 / kelvin);

  const double sulphate = 21.44 * s / c * (1.0 + 0.025 * t) * (1.0 - 1.37e-4 * d + 6.2e-9 * d * d);
  const double sulphate_khz = 8.17 * std::pow(10.0, 8.0 - 1990.0 / kelvin) / (1.0 + 0.0018 * (s - 35.0));

  const double viscosity = t <= 20.0 ? 4.937e-4 + t * (-2.59e-5 + t * (9.11e-7 - t * 1.5e-8))
                                     : 3.964e-4 + t * (-1.146e-5 + t * (1.45e-7 - t * 6.5e-10));
  const double pressure = 1.0 - 3.83e-5 * d + 4.9e-10 * d * d;

  const double db_per_km =
      boric * relaxation(f, boric_khz) + sulphate * relaxation(f, sulphate_khz) + viscosity * pressure * f * f;
  return db_per_km * 1e-3;
}

double absorption_ainslie_mccolm(double frequency_hz, const WaterProperties& water) {
  const double f = frequency_hz * 1e-3;
  const double t = water.temperature_c;
  const double s = water.salinity_psu;
  const double depth_km = water.depth_m * 1e-3;
  const double boric_khz = 0.78 * std::sqrt(s / 35.0) * std::exp(t / 26.0);
  const double sulphate_khz = 42.0 * std::exp(t / 17.0);
  const double db_per_km =
      0.106 * relaxation(f, boric_khz) * std::exp((water.ph - 8.0) / 0.56) +
      0.52 * (1.0 + t / 43.0) * (s / 35.0) * relaxation(f, sulphate_khz) * std::exp(-depth_km / 6.0) +
      0.00049 * f * f * std::exp(-(t / 27.0 + depth_km / 17.0));
  return db_per_km * 1e-3;
}

double sound_speed_mackenzie(const WaterProperties& water) {
  const double t = water.temperature_c;
  const double s = water.salinity_psu - 35.0;
  const double d = water.depth_m;
  return 1448.96 + 4.591 * t - 5.304e-2 * t * t + 2.374e-4 * t * t * t + 1.340 * s + 1.630e-2 * d + 1.675e-7 * d * d -
         1.025e-2 * t * s - 7.139e-13 * t * d * d * d;
}

}  // namespace sonar
