// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/school.h"
#include "synth/array/company.h"
#include "synth/array/fish_school.h"
#include "synth/truth.h"

namespace sonar::synth::array {

/// A school in one ping by its fish: a row of truth/fish.csv.
struct FishTruth {
  std::string observation;
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  std::string form;
  std::int64_t fish = 0;
  double fish_length_cm = kUnknown;
  double sigma_bs_m2 = kUnknown;  ///< sum of single echoes' means at their aspect
  double ts_mean_db = kUnknown;   ///< of one fish, linear mean
  double per_m3 = kUnknown;       ///< over the inhabited volume
  double length_m = kUnknown;     ///< full extents along the axis, across it, up
  double width_m = kUnknown;
  double height_m = kUnknown;
  double axis_deg = kUnknown;
};
template <class Visitor>
void columns(Visitor& v, FishTruth& r) {
  v("observation", "", r.observation);
  v("school_id", "", r.school_id);
  v("ping_index", "", r.ping_index);
  v("form", "", r.form);
  v("fish", "1", r.fish);
  v("fish_length_cm", "cm", r.fish_length_cm);
  v("sigma_bs_m2", "m2", r.sigma_bs_m2);
  v("ts_mean_db", "dB re 1 m2", r.ts_mean_db);
  v("per_m3", "m-3", r.per_m3);
  v("length_m", "m", r.length_m);
  v("width_m", "m", r.width_m);
  v("height_m", "m", r.height_m);
  v("axis_deg", "degrees", r.axis_deg);
}

/// A box of the grid in one ping in which something lies that is no school: a row of truth/company.csv. Bounds are
/// included.
struct CompanyTruth {
  std::string observation;
  std::int64_t ping_index = 0;
  std::string kind;
  std::int64_t first_fan = 0, last_fan = 0;
  std::int64_t first_beam = 0, last_beam = 0;
  std::int64_t first_sample = 0, last_sample = 0;
  double backscatter_m2 = kUnknown;  ///< of what is made of single echoes
};
template <class Visitor>
void columns(Visitor& v, CompanyTruth& r) {
  v("observation", "", r.observation);
  v("ping_index", "", r.ping_index);
  v("kind", "", r.kind);
  v("first_fan", "", r.first_fan);
  v("last_fan", "", r.last_fan);
  v("first_beam", "", r.first_beam);
  v("last_beam", "", r.last_beam);
  v("first_sample", "", r.first_sample);
  v("last_sample", "", r.last_sample);
  v("backscatter_m2", "m2", r.backscatter_m2);
}

/// What the table says of a beam and what is true: a row of truth/beams.csv.
struct BeamTruth {
  std::int64_t channel = 0;
  double elevation_deg = 0.0;
  double azimuth_deg = 0.0;
  double psi_stated_db = 0.0;
  double psi_true_db = 0.0;
  double sa_correction_db = 0.0;
  double sa_stated_db = 0.0;
  double gain_db = 0.0;
  double gain_stated_db = 0.0;
  double width_along_deg = 0.0;    ///< -3 dB of the one-way beam whose square the two-way one is: upright ...
  double width_athwart_deg = 0.0;  ///< ... and along the fan
  double sphere_ts_db = kUnknown;  ///< of the sphere in this beam's pulse
};
template <class Visitor>
void columns(Visitor& v, BeamTruth& r) {
  v("channel", "", r.channel);
  v("elevation_deg", "degrees", r.elevation_deg);
  v("azimuth_deg", "degrees", r.azimuth_deg);
  v("psi_stated_db", "dB re 1 sr", r.psi_stated_db);
  v("psi_true_db", "dB re 1 sr", r.psi_true_db);
  v("sa_correction_db", "dB", r.sa_correction_db);
  v("sa_stated_db", "dB", r.sa_stated_db);
  v("gain_db", "dB", r.gain_db);
  v("gain_stated_db", "dB", r.gain_stated_db);
  v("width_along_deg", "degrees", r.width_along_deg);
  v("width_athwart_deg", "degrees", r.width_athwart_deg);
  v("sphere_ts_db", "dB re 1 m2", r.sphere_ts_db);
}

/// A strength of the water of an observation: a row of truth/water.csv.
struct WaterTruth {
  std::string observation;
  std::string name;
  double value = 0.0;
};
template <class Visitor>
void columns(Visitor& v, WaterTruth& r) {
  v("observation", "", r.observation);
  v("name", "", r.name);
  v("value", "", r.value);
}
[[nodiscard]] std::vector<WaterTruth> water_rows(const std::string& observation, const Sea& sea);

/// One fish (or those together) as a ping has it.
struct PlacedEcho {
  Point<Enu> at;  ///< from the transducer
  double expected_m2 = 0.0;
};
/// Rows of bodies.csv and fish.csv.
[[nodiscard]] BodyTruth body_row(const School& school, const View& view, const Sector& sector,
                                 const std::vector<PlacedEcho>& echoes, int ping);
[[nodiscard]] FishTruth fish_row(const School& school, const BodyTruth& body);

}  // namespace sonar::synth::array
