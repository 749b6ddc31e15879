// SPDX-License-Identifier: Apache-2.0
#include "synth/array/params.h"

#include <fmt/format.h>

#include <string_view>

#include "synth/random.h"

namespace sonar::synth::array {

Result<void> check(const ArrayParams& p) {
  if (auto ok = validate(p); !ok) return ok;
  struct Span {
    std::string_view least_name, most_name;
    double least, most;
  };
  const std::array<Span, 6> spans{
      {{"range_min_m", "range_max_m", p.range_min_m, p.range_max_m},
       {"length_min_m", "length_max_m", p.length_min_m, p.length_max_m},
       {"fish.length_min_cm", "fish.length_max_cm", p.fish.length_min_cm, p.fish.length_max_cm},
       {"fish.per_m3_min", "fish.per_m3_max", p.fish.per_m3_min, p.fish.per_m3_max},
       {"sphere.elevation_from_deg", "sphere.elevation_to_deg", p.sphere.elevation_from_deg, p.sphere.elevation_to_deg},
       {"sphere.azimuth_from_deg", "sphere.azimuth_to_deg", p.sphere.azimuth_from_deg, p.sphere.azimuth_to_deg}}};
  for (const Span& span : spans) {
    if (span.least <= span.most) continue;
    return fail(ErrorCode::bad_parameter,
                fmt::format("{} = {} is more than {} = {}", span.least_name, span.least, span.most_name, span.most));
  }
  return {};
}

ArrayParams sphere_run() {
  ArrayParams p;
  p.observations = 1;
  p.pings = 300;
  p.schools = 0;
  p.waters = Waters::stated;
  p.speed_knots = 0.0;
  p.ping_interval_s = 1.0;
  p.motion_deg = 0.2;
  p.elements.gain_error_db = 0.5;
  p.elements.sa_error_db = 0.1;
  p.sphere.diameter_mm = 38.1;
  // Some 60 beams, which so many pings cross.
  p.sphere.elevation_from_deg = -20.0;
  p.sphere.elevation_to_deg = -5.0;
  p.sphere.azimuth_from_deg = -12.0;
  p.sphere.azimuth_to_deg = 12.0;
  Company& c = p.company;
  c.hull_bubbles = c.plumes = c.surface = c.layers = c.seabed = c.other_sounders = c.refraction = c.unsteady = 0.0;
  c.single_fish = 0.3;
  return p;
}

Company company_of(const ArrayParams& params, int observation) {
  if (params.waters == Waters::stated) return params.company;
  constexpr double kAbsent = 0.3;
  RandomStream random(static_cast<std::uint64_t>(params.seed), Purpose::water, static_cast<std::uint32_t>(observation));
  const auto strength = [&random] {
    const double there = random.uniform();
    const double much = random.uniform(0.15, 1.0);
    return there < kAbsent ? 0.0 : much;
  };
  Company c;
  c.hull_bubbles = strength();
  c.plumes = strength();
  c.surface = strength();
  c.layers = strength();
  c.single_fish = strength();
  c.seabed = strength();
  c.other_sounders = strength();
  c.refraction = strength();
  c.unsteady = strength();
  c.noise_power_db = random.uniform(-174.0, -164.0);
  c.reverberation_sv_db = random.uniform(-92.0, -80.0);
  c.seabed_depth_m = random.uniform(70.0, 320.0);
  return c;
}

}  // namespace sonar::synth::array
