// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"

namespace sonar {

/// The water a sound travels through.
struct WaterProperties {
  double temperature_c = 8.0;
  double salinity_psu = 35.0;
  double depth_m = 50.0;  ///< positive down
  double ph = 8.0;
};

template <class Visitor>
void describe(Visitor& v, WaterProperties& p) {
  v.field("temperature_c", p.temperature_c,
          {.unit = "deg C",
           .min = -2,
           .max = 40,
           .text = "Water temperature for the absorption formulas; set it to the mean of a CTD cast over the depths of "
                   "the beams.",
           .tier = Tier::basic});
  v.field("salinity_psu", p.salinity_psu,
          {.unit = "psu",
           .min = 0,
           .max = 45,
           .text = "Salinity for the absorption formulas; lower it in brackish water.",
           .tier = Tier::basic});
  v.field("depth_m", p.depth_m,
          {.unit = "m",
           .min = 0,
           .max = 8000,
           .text = "Depth for which absorption is worked out; set it to the middle of the depths of the beams."});
  v.field("ph", p.ph,
          {.unit = "",
           .min = 7,
           .max = 9,
           .text = "pH of the water for the absorption formulas; set it where it was measured and the sounder's "
                   "frequency is low, since it matters little above 20 kHz."});
}

/// Absorption of sound in sea water, dB/m one way, by boric acid, magnesium sulphate and water.
/// sound_speed_mps  0 = the formula's own, from temperature, salinity and depth
/// source  Francois & Garrison, J. Acoust. Soc. Am. 72 (1982) 1879
[[nodiscard]] double absorption_francois_garrison(double frequency_hz, const WaterProperties& water,
                                                  double sound_speed_mps = 0.0);

/// The same by the simplified formula, within some per cent of the above.
/// source  Ainslie & McColm, J. Acoust. Soc. Am. 103 (1998) 1671
[[nodiscard]] double absorption_ainslie_mccolm(double frequency_hz, const WaterProperties& water);

/// Sound speed in m/s; valid for -2..30 deg C, 30..40 psu, 0..8000 m.
/// source  Mackenzie, J. Acoust. Soc. Am. 70 (1981) 807
[[nodiscard]] double sound_speed_mackenzie(const WaterProperties& water);

}  // namespace sonar
