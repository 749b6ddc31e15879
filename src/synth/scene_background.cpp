// SPDX-License-Identifier: Apache-2.0
#include "synth/scene_background.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "synth/random.h"

namespace sonar::synth {
namespace {

constexpr double kNothing_db = -200.0;

double strength(double db) { return db > kNothing_db ? linear_from_db(db) : 0.0; }

/// The sonar equation the other way: received power in dB re 1 W for Sv = 0 dB at range r.
double power_db_at_zero_sv(const Beam& beam, double range_m) {
  const double wavelength_m = kSoundSpeed_mps / beam.frequency_hz;
  const double pi2 = std::numbers::pi * std::numbers::pi;
  const double transmitted =
      beam.power_w * wavelength_m * wavelength_m * kSoundSpeed_mps * kPulseLength_s / (32.0 * pi2);
  return db_from_linear(transmitted) + 2.0 * beam.gain_db + beam.psi_db + 2.0 * beam.sa_correction_db -
         20.0 * std::log10(range_m) - 2.0 * beam.absorption_db_per_m * range_m;
}

/// sv of the sea surface at range r: a patch r dphi dr of it, over the volume r^2 dOmega dr that the beam looks into.
double surface_sv(BeamPattern pattern, const RowBeam& row, double range_m, double depth_m, double strength_per_m2) {
  if (strength_per_m2 <= 0.0 || range_m <= depth_m) return 0.0;
  const double elevation = std::asin(depth_m / range_m);
  return strength_per_m2 * vertical_density(pattern, row, elevation) / (range_m * std::cos(elevation));
}

RowLimits limits(const Layout& layout, const RowBeam& row, double depth_m) {
  RowLimits l;
  l.near_end = std::clamp(static_cast<int>(std::ceil(layout.range.sample_at(kTruthNear_m))), 0, row.count);
  l.count = row.count;
  l.surface_begin = row.count;
  l.seabed_begin = row.count;
  const double upper_edge = row.elevation_rad + row.vertical_width_rad / 2.0;
  if (upper_edge > 0.0) {
    const double reaches_m = std::max(0.0, depth_m - kTruthSurfaceMargin_m) / std::sin(upper_edge);
    const double sample = std::ceil(layout.range.sample_at(reaches_m));
    l.surface_begin = sample < row.count ? std::max(0, static_cast<int>(sample)) : row.count;
  }
  return l;
}

}  // namespace

Background make_background(const Layout& layout, const Scene& scene) {
  Background b{Array3<float>(layout.shape), Array3<float>(layout.shape), {}};
  const Noise& noise = scene.noise;
  const double reverberation = noise.scale * linear_from_db(scene.water.reverberation_sv_db);
  const double surface = noise.scale * strength(scene.water.surface_db);
  const double ringing = noise.scale * strength(noise.ringing_power_db);
  for (int r = 0; r < static_cast<int>(layout.rows.size()); ++r) {
    const RowBeam& row = layout.rows[static_cast<std::size_t>(r)];
    RandomStream random(scene.seed, Purpose::beam_noise, 0, 0, static_cast<std::uint32_t>(row.channel));
    const double spread_db = noise.background_spread_db * std::clamp(random.normal(), -3.0, 3.0);
    const double noise_w = noise.scale * linear_from_db(noise.background_power_db + spread_db);
    const auto per_sv = b.power_per_sv.view().row(r);
    const auto power = b.power_w.view().row(r);
    for (int s = 0; s < layout.shape.samples; ++s) {
      const double range_m = std::max(layout.range.spacing_m, layout.range.range_m(s));
      const double factor = linear_from_db(power_db_at_zero_sv(layout.beam(r), range_m));
      const double sv =
          reverberation + surface_sv(layout.pattern, row, range_m, scene.ship.transducer_depth_m, surface);
      const auto i = static_cast<std::size_t>(s);
      per_sv[i] = static_cast<float>(factor);
      power[i] =
          static_cast<float>(noise_w + ringing * linear_from_db(-noise.ringing_decay_db_per_m * range_m) + factor * sv);
    }
    b.limits.push_back(limits(layout, row, scene.ship.transducer_depth_m));
  }
  return b;
}

}  // namespace sonar::synth
