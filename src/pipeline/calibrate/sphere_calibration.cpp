// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibrate/sphere_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "base/units.h"
#include "pipeline/survey/beam_figures.h"
#include "signal/point_echo.h"

namespace sonar {
namespace {

/// The sound speed of the water is known so well, and a received pulse may have the band of an untapered one times this;
/// the sphere's TS must not change by more with both: near a null of the series a sphere is no measure.
constexpr double kSpeedKnown_mps = 1.0;
constexpr double kBandKnown = 1.4;
constexpr double kSteepest_db = 0.2;
/// What lies beyond the main lobe is not in the fitted pattern's integral: side lobes of a shaded array hold so much.
constexpr double kBeyondLobe_db = 0.15;
/// An echo tells the pulse's form where noise is this small.
constexpr double kClear_db = 0.5;
constexpr double kPerLog = 10.0 / std::numbers::ln10;  ///< dB for a natural logarithm

double square(double x) { return x * x; }
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

/// All that is fitted together: the pings of several observations, one after the other.
struct Gathered {
  std::vector<SphereLevel> echoes;  ///< [level of SphereCalibration::levels]
  int pings = 0;
};

/// A track's levels; its pings count from `first_ping` on.
std::vector<HeardLevel> heard_of(const SphereTrack& track, int first_ping) {
  std::vector<HeardLevel> heard;
  std::size_t at = 0;
  for (const SphereLevel& level : track.levels) {
    while (track.at[at].ping != level.ping) ++at;
    heard.push_back({first_ping + static_cast<int>(at), level.row, level.level_db, level.se_db});
  }
  return heard;
}

/// The target by which most beams can be calibrated, of those whose levels fit together: a fish's strength changes as it turns.
/// The likeliest where they are alike.
const SphereTrack& sphere_among(const std::vector<SphereTrack>& targets, const SphereBeams& beams, const Work& work) {
  constexpr double kMuchWorse = 1.7;
  if (targets.size() == 1) return targets.front();
  struct Suits {
    std::ptrdiff_t crossed;
    double rms_db;
  };
  std::vector<Suits> all;
  double least_db = std::numeric_limits<double>::infinity();
  for (const SphereTrack& target : targets) {
    if (work.cancelled()) return targets.front();
    const PatternFit fit = fit_patterns(beams.stated, heard_of(target, 0), static_cast<int>(target.at.size()));
    all.push_back({std::count(fit.crossed.begin(), fit.crossed.end(), true), fit.residual_rms_db});
    if (all.back().crossed > 0) least_db = std::min(least_db, fit.residual_rms_db);
  }
  std::size_t best = 0;
  std::ptrdiff_t most = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    if (all[t].crossed <= most || all[t].rms_db > kMuchWorse * least_db) continue;
    most = all[t].crossed;
    best = t;
  }
  return targets[best];
}

void gather(const SphereTrack& track, SphereCalibration& out, Gathered& all) {
  const std::vector<HeardLevel> heard = heard_of(track, all.pings);
  out.levels.insert(out.levels.end(), heard.begin(), heard.end());
  all.echoes.insert(all.echoes.end(), track.levels.begin(), track.levels.end());
  all.pings += static_cast<int>(track.at.size());
  for (const SphereAt& sphere : track.at) {
    out.range_from_m = out.found == 0 ? sphere.range_m : std::min(out.range_from_m, sphere.range_m);
    out.range_to_m = std::max(out.range_to_m, sphere.range_m);
    ++out.found;
  }
}

/// 10 log10(integral over the echo / (its top x pulse length)), each beam's, from the clear echoes inside it.
std::vector<EchoTop> tops_of(const Gathered& all, const SphereCalibration& out, std::size_t rows) {
  std::vector<OffTop> clear;
  for (std::size_t i = 0; i < out.levels.size(); ++i) {
    const auto beam = static_cast<std::size_t>(out.levels[i].beam);
    const bool inside = out.levels[i].level_db > out.fit.beams[beam].level_db - kHalfBothWays_db;
    if (!inside || !std::isfinite(out.fit.residual_db[i]) || out.levels[i].se_db > kClear_db) continue;
    clear.push_back({beam, all.echoes[i].off_samples, all.echoes[i].share_db});
  }
  return echo_tops(clear, rows);
}

BeamCalibration stated_figures(const ObservationFiles& observation, const SphereBeams& beams, std::size_t row) {
  BeamCalibration b;
  b.channel = observation.grid->channel[row];
  b.gain_db = beams.calibration[row].gain_db;
  b.sa_correction_db = beams.calibration[row].sa_correction_db;
  b.psi_db = observation.config.beams[static_cast<std::size_t>(b.channel)].equivalent_beam_angle_db;
  b.width_along_deg = observation.grid->vertical_width_deg[row];
  b.width_athwart_deg = observation.grid->horizontal_width_deg[row];
  return b;
}

/// sa_db  10 log10 of the echo's integral over top and pulse, its standard error
BeamCalibration fitted_figures(const FittedBeam& beam, const BeamErrors& errors, const PatternShape& shape,
                               double sa_db, double sa_se_db) {
  using Error = BeamErrors;
  const auto& c = errors.covariance;
  const double cos_azimuth =
      std::sqrt(std::max(1e-4, 1.0 - square(beam.centre.across) / (1.0 - square(beam.centre.up))));
  BeamCalibration b;
  b.sa_correction_db = sa_db / 2.0;
  b.sa_correction_db_se = sa_se_db / 2.0;
  b.gain_db = beam.level_db / 2.0 - b.sa_correction_db;
  b.gain_db_se = std::hypot(std::sqrt(c[Error::level_db][Error::level_db]) / 2.0, b.sa_correction_db_se);
  b.psi_db = db_from_linear(psi_sr(beam, shape));
  const double widths = c[Error::log_width_across][Error::log_width_across] +
                        c[Error::log_width_up][Error::log_width_up] +
                        2.0 * c[Error::log_width_across][Error::log_width_up];
  b.psi_db_se = std::hypot(kPerLog * std::sqrt(std::max(0.0, widths)), kBeyondLobe_db);
  b.width_along_deg = deg_from_rad(beam.width_up) / std::sqrt(1.0 - square(beam.centre.up));
  b.width_along_deg_se = b.width_along_deg * std::sqrt(c[Error::log_width_up][Error::log_width_up]);
  b.width_athwart_deg = deg_from_rad(beam.width_across) / cos_azimuth;
  b.width_athwart_deg_se = b.width_athwart_deg * std::sqrt(c[Error::log_width_across][Error::log_width_across]);
  columns([](const char*, double& value, double, double) { value = rounded(value); }, b);
  return b;
}

double ts_per_mps(const SphereRunParams& params, const ChannelCalibration& c) {
  constexpr double kStep_mps = 1.0;
  const auto at = [&](double off_mps) {
    WaterAround water = params.water;
    water.sound_speed_mps += off_mps;
    return sphere_ts_db(params.sphere, water, c.frequency_hz, c.pulse_length_s);
  };
  return std::max(std::abs(at(kStep_mps) - at(0.0)), std::abs(at(-kStep_mps) - at(0.0))) / kStep_mps;
}

/// By what is not known of the water and of the pulse.
double ts_se_db(const SphereRunParams& params, const ChannelCalibration& c, double ts_db, double per_mps_db) {
  const double other_band_db = sphere_ts_db(params.sphere, params.water, c.frequency_hz, c.pulse_length_s / kBandKnown);
  return std::hypot(kSpeedKnown_mps * per_mps_db, other_band_db - ts_db);
}

void fill_beams(const ObservationFiles& observation, const SphereBeams& beams, const SphereRunParams& params,
                const std::vector<EchoTop>& tops, SphereCalibration& out) {
  const BeamGrid& grid = *observation.grid;
  const PatternFit& fit = out.fit;
  const double pulses_per_sample = observation.sample_interval_s / observation.pulse_length_s;
  for (std::size_t row = 0; row < grid.channel.size(); ++row) {
    CalibratedBeam& b = out.beams.emplace_back();
    b.fan = static_cast<int>(row) / grid.beams();
    b.beam = static_cast<int>(row) % grid.beams();
    b.elevation_deg = grid.elevation_deg[static_cast<std::size_t>(b.fan)];
    b.azimuth_deg = grid.azimuth_deg[static_cast<std::size_t>(b.beam)];
    b.frequency_hz = beams.calibration[row].frequency_hz;
    b.ts_db = beams.ts_db[row];
    b.before = stated_figures(observation, beams, row);
    b.after.channel = b.before.channel;
    if (!beams.sound[row]) continue;
    b.ts_per_mps_db = ts_per_mps(params, beams.calibration[row]);
    b.hits = fit.hits[row];
    const double ts_se = ts_se_db(params, beams.calibration[row], b.ts_db, b.ts_per_mps_db);
    b.crossed = fit.crossed[row] && ts_se <= kSteepest_db;
    b.near_null = fit.crossed[row] && !b.crossed;
    if (!b.crossed) continue;
    BeamErrors errors = fit.errors[row];
    errors.covariance[BeamErrors::level_db][BeamErrors::level_db] += square(ts_se);
    const double sa_db = db_from_linear(pulses_per_sample) - tops[row].share_db;
    b.after = fitted_figures(fit.beams[row], errors, fit.shape, sa_db, tops[row].se_db);
    b.after.channel = b.before.channel;
    b.off_across_deg = deg_from_rad(fit.beams[row].centre.across - beams.stated[row].centre.across);
    b.off_up_deg = deg_from_rad(fit.beams[row].centre.up - beams.stated[row].centre.up);
  }
  for (std::size_t i = 0; i < out.levels.size(); ++i) {
    out.beams[static_cast<std::size_t>(out.levels[i].beam)].levels.push_back(i);
  }
}

}  // namespace

std::size_t SphereCalibration::crossed() const {
  return static_cast<std::size_t>(
      std::count_if(beams.begin(), beams.end(), [](const CalibratedBeam& b) { return b.crossed; }));
}

Result<SphereSize> sphere_size(std::string_view name) {
  const auto sphere = named_sphere(name);
  if (!sphere) return pass_on(sphere);
  const auto at = std::find_if(kSphereMaterials.begin(), kSphereMaterials.end(),
                               [&](const SphereMaterial& one) { return one.name == sphere->material.name; });
  return SphereSize{static_cast<std::size_t>(at - kSphereMaterials.begin()), sphere->diameter_m * 1e3};
}

std::string sphere_name(const SphereSize& size) {
  return fmt::format("{}{}", kSphereMaterials[size.material].name, size.diameter_mm);
}

std::string material_text(std::size_t material) {
  const SphereMaterial& m = kSphereMaterials[material];
  return fmt::format("{}: {} kg/m\u00B3, {} and {} m/s ({})", m.text, m.density_kg_per_m3, m.longitudinal_mps,
                     m.transverse_mps, m.source);
}

Result<SphereRunParams> sphere_run_params(const SphereChoice& choice, const WaterProperties& recipe_water,
                                          const SurveyFiles& survey) {
  const auto sphere = named_sphere(choice.sphere);
  if (!sphere) return fail(ErrorCode::usage, sphere.error().text);
  SphereRunParams params{*sphere, {}, choice.range_from_m, choice.range_to_m};
  if (!(params.range_from_m >= 0.0 && params.range_from_m < params.range_to_m)) {
    return fail(ErrorCode::usage, fmt::format("range {},{}: expected the nearer and the farther range in metres",
                                              params.range_from_m, params.range_to_m));
  }
  const WaterProperties& water = choice.water.value_or(recipe_water);
  if (auto valid = validate(water); !valid && choice.water) {
    return fail(ErrorCode::usage, fmt::format("water {},{},{}: {}", water.temperature_c, water.salinity_psu,
                                              water.depth_m, valid.error().text));
  }
  params.water = {sound_speed_mackenzie(water), sea_water_density(water)};
  const auto with_grid = std::find_if(survey.observations.begin(), survey.observations.end(),
                                      [](const ObservationFiles& one) { return one.grid.has_value(); });
  if (!choice.water && with_grid != survey.observations.end()) {
    params.water.sound_speed_mps = with_grid->sound_speed_mps;
  }
  return params;
}

Result<SphereCalibration> calibrate_by_sphere(const SurveyFiles& survey, const CalibrationParams& calibration,
                                              const SphereRunParams& params, Work& work) {
  SphereCalibration out;
  Gathered all;
  const ObservationFiles* first = nullptr;
  SphereBeams beams;
  for (const ObservationFiles& observation : survey.observations) {
    const bool alike = observation.grid && (first == nullptr || (*observation.grid == *first->grid &&
                                                                 observation.pulse_length_s == first->pulse_length_s));
    if (!alike) {
      out.left_out.push_back(observation.name);
      continue;
    }
    SphereBeams here = sphere_beams(observation, calibration, params);
    const auto targets = find_targets(survey, observation, here, calibration, params, work);
    if (!targets) return pass_on(targets);
    out.observations.push_back(observation.name);
    out.pings += static_cast<std::int64_t>(observation.pings.size());
    gather(sphere_among(*targets, here, work), out, all);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    if (first != nullptr) continue;
    first = &observation;
    beams = std::move(here);
  }
  if (first == nullptr) {
    return fail(ErrorCode::unsupported,
                "no observation has fans of beams: the direction of a sphere is found from "
                "neighbouring beams alone");
  }
  out.fit = fit_patterns(beams.stated, out.levels, all.pings);
  out.used = std::count(out.fit.used.begin(), out.fit.used.end(), true);
  fill_beams(*first, beams, params, tops_of(all, out, beams.stated.size()), out);
  if (out.crossed() == 0) {
    return fail(
        ErrorCode::mismatch,
        fmt::format("a sphere of {:.1f} dB was found in {} of {} pings and crossed no beam: expected 8 pings in "
                    "the middle of a beam; is it the right sphere, and the right range?",
                    out.beams.front().ts_db, out.used, out.pings));
  }
  return out;
}

}  // namespace sonar
