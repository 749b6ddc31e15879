// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/measure_ping.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "pipeline/survey/beam_figures.h"
#include "school/measure/extinction.h"
#include "school/measure/measure.h"
#include "school/measure/school_errors.h"
#include "school/measure/total_echo.h"

namespace sonar {
namespace {

PingMask others_than(const std::vector<InPingRef>& all, std::size_t index) {
  PingMask others;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i != index) others = unite(others, all[i].in_ping->mask);
  }
  return others;
}

/// What measuring needs to know of a ping, whatever the school.
MeasureInput input_of(const Engine& engine, const StagedPing& ping, double area) {
  const ObservationFiles& observation = engine.observation();
  MeasureInput input;
  input.sv = ping.sv.counts.view();
  input.filtered = ping.filtered->counts.view();
  input.flags = ping.sv.flags.view();
  input.sector = &engine.sector();
  input.grid = &engine.grid();
  input.background = ping.background();
  input.placement = engine.placement(ping.ping_index);
  input.rays = engine.rays();
  input.pulse_m = observation.sound_speed_mps * observation.pulse_length_s / 2.0;
  input.two_way_area = area;
  input.psi_error_db = engine.beam_figures().psi_error_db;
  input.calibration_se_db = engine.beam_figures().calibration_se_db;
  input.seabed = ping.seabed.found ? &ping.seabed : nullptr;
  return input;
}

MeasuredMask measure_one(const Engine& engine, const StagedPing& ping, const std::vector<InPingRef>& all,
                         std::size_t index, MeasureInput input) {
  const ObservationFiles& observation = engine.observation();
  const PingMask others = others_than(all, index);
  input.others = &others;
  input.threshold_db = all[index].in_ping->threshold_db;
  MeasuredSchool school = measure(input, all[index].in_ping->mask, engine.recipe().measure);
  SchoolPingRow& row = school.row;
  const PingNavigation& at = observation.navigation[static_cast<std::size_t>(ping.ping_index)];
  // Whoever does not know which way the ship lay knows neither bearing nor place.
  if (std::isnan(at.heading_deg)) {
    row.latitude = row.longitude = row.bearing_deg = row.axis_deg = kUnknown;
    row.mass_latitude = row.mass_longitude = row.box_bearing_deg = row.box_tilt_deg = kUnknown;
  }
  row.observation = observation.name;
  row.school_id = all[index].school->decided.school_id;
  row.ping_index = ping.ping_index;
  row.time_utc = at.time;
  const Recipe& recipe = engine.recipe();
  Repeats repeats =
      measure_repeats(input, all[index].in_ping->mask, engine.filter_box(), recipe.detect.tolerance_db,
                      static_cast<std::uint64_t>(at.time), all[index].fadings, recipe.measure, recipe.errors);
  return {std::move(school), faulty_members(input, all[index].in_ping->mask), std::move(repeats)};
}

/// A ping as schools are measured in it: what fish take out of its beams is told, and given back where the recipe corrects.
struct ShadowedPing {
  ShadowedPing(const MeasureInput& heard, std::span<const PingMask* const> fish, const ExtinctionParams& params)
      : shadow(heard, fish, params), input(heard) {
    if (!params.correct) return;
    sv = without_extinction(heard.sv, heard.background, shadow.gain(), 1.0);
    filtered = without_extinction(heard.filtered, heard.background, shadow.gain(), std::numbers::ln2);
    input.sv = std::as_const(sv).view();
    input.filtered = std::as_const(filtered).view();
  }
  ShadowedPing(const ShadowedPing&) = delete;
  ShadowedPing& operator=(const ShadowedPing&) = delete;

  PingShadow shadow;
  Array3<std::int16_t> sv;
  Array3<std::int16_t> filtered;
  MeasureInput input;
};

}  // namespace

bool is_fish(const InPingRef& school) { return school.school->decided.status != "rejected"; }

std::vector<MeasuredMask> measure_ping(const StagedPing& ping, const Engine& engine,
                                       const std::vector<InPingRef>& schools, double area) {
  MeasureInput input = input_of(engine, ping, area);
  std::vector<const PingMask*> masks;
  std::vector<const PingMask*> fish;
  for (const InPingRef& school : schools) {
    masks.push_back(&school.in_ping->mask);
    if (is_fish(school)) fish.push_back(masks.back());
  }
  std::optional<EchoClaims> claims;
  if (schools.size() > 1) {
    claims = echo_claims(input, masks);
    input.claims = &*claims;
  }
  const ExtinctionParams& extinction = engine.recipe().measure.extinction;
  const ShadowedPing by_fish(input, fish, extinction);
  std::vector<MeasuredMask> rows;
  for (std::size_t i = 0; i < schools.size(); ++i) {
    std::optional<ShadowedPing> by_it_too;  // a rejected school's own row tells what it would be as fish
    if (!is_fish(schools[i])) {
      std::vector<const PingMask*> with = fish;
      with.push_back(masks[i]);
      by_it_too.emplace(input, with, extinction);
    }
    const ShadowedPing& heard = by_it_too ? *by_it_too : by_fish;
    rows.push_back(measure_one(engine, ping, schools, i, heard.input));
    heard.shadow.tell(*masks[i], rows.back().school.row);
  }
  return rows;
}

}  // namespace sonar
