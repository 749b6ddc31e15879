// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geo/frames.h"
#include "model/school.h"
#include "synth/array/params.h"
#include "synth/array/pulse.h"
#include "synth/array/receiver.h"
#include "synth/array/view.h"

namespace sonar::synth::array {

/// Backscattering amplitude of an elastic sphere at one frequency, m: its square is sigma_bs.
/// source  Faran, Sound scattering by solid cylinders and spheres, J. Acoust. Soc. Am. 23 (1951) 405, with the correction
///         of the term for the shear wave that Hickling (1962) gives. By phase angles; the programs that are judged use
///         another form of the series
[[nodiscard]] double sphere_amplitude_m(const SphereParams& params, double frequency_hz);

/// The same for the received pulse: the root of sigma_bs averaged over that pulse's own energy spectrum.
[[nodiscard]] double sphere_amplitude_m(const SphereParams& params, double frequency_hz, const Pulse& pulse,
                                        double pulse_length_s);

/// Of each fan of a sonar, [fan].
[[nodiscard]] std::vector<double> sphere_amplitudes_m(const SphereParams& params, const Receiver& receiver);

/// Where the sphere hangs in a ping, as the ship sees it: its lines are drawn in so that it goes to and fro along the beams
/// of one elevation after the other, upwards, swinging a little.
struct SphereTruth {
  std::string observation;
  std::int64_t ping_index = 0;
  double range_m = kUnknown;
  double elevation_deg = kUnknown;
  double azimuth_deg = kUnknown;  ///< from abeam, positive towards the bow
};
template <class Visitor>
void columns(Visitor& v, SphereTruth& r) {
  v("observation", "", r.observation);
  v("ping_index", "", r.ping_index);
  v("range_m", "m", r.range_m);
  v("elevation_deg", "degrees", r.elevation_deg);
  v("azimuth_deg", "degrees", r.azimuth_deg);
}
[[nodiscard]] SphereTruth sphere_at(const SphereParams& params, int ping, int pings, std::uint64_t seed);
[[nodiscard]] Point<Enu> place_of(const SphereTruth& sphere, const View& view);

}  // namespace sonar::synth::array
