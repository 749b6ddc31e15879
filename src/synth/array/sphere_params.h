// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"

namespace sonar::synth::array {

enum class SphereMaterial { tungsten_carbide, copper };
inline constexpr std::array<std::string_view, 2> kSphereMaterialNames = {"tungsten_carbide", "copper"};
/// A calibration sphere that is steered through the beams.
struct SphereParams {
  double diameter_mm = 0.0;
  SphereMaterial material = SphereMaterial::tungsten_carbide;
  double range_m = 60.0;
  double elevation_from_deg = -45.0;
  double elevation_to_deg = 0.0;
  double azimuth_from_deg = -30.0;
  double azimuth_to_deg = 30.0;
};

template <class Visitor>
void describe(Visitor& v, SphereParams& p) {
  v.field("diameter_mm", p.diameter_mm,
          {.unit = "mm",
           .min = 0,
           .max = 200,
           .text = "Diameter of the sphere; 0 for none. Choose 38.1 to test a calibration with the usual sphere of "
                   "tungsten carbide. Where there is one, pings are recorded to 30 m beyond it."});
  v.choice("material", p.material, kSphereMaterialNames,
           "What the sphere is made of. Choose copper to test a calibration with the other usual kind.");
  v.field("range_m", p.range_m,
          {.unit = "m",
           .min = 20,
           .max = 400,
           .text = "Range at which the sphere hangs, which varies by some metres. Raise it to test a calibration with "
                   "weak echoes."});
  const auto bound = [&v](std::string_view name, double& value, double most, std::string_view text) {
    v.field(name, value, {.unit = "deg", .min = -most, .max = most, .text = text});
  };
  bound("elevation_from_deg", p.elevation_from_deg, 90,
        "Elevation of the lowest line that the sphere is steered along. Raise it to leave out the deep fans.");
  bound("elevation_to_deg", p.elevation_to_deg, 90,
        "Elevation of the uppermost line that the sphere is steered along. Lower it to leave out the upper fans.");
  bound("azimuth_from_deg", p.azimuth_from_deg, 90,
        "Azimuth from abeam, positive to the bow, at the aft end of the lines. Raise it to leave out the aft beams.");
  bound("azimuth_to_deg", p.azimuth_to_deg, 90,
        "Azimuth from abeam at the fore end of the lines. Lower it to leave out the forward beams.");
}

}  // namespace sonar::synth::array
