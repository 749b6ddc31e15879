// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "synth/scene.h"

namespace sonar::synth {

enum class Preset { easy, standard, hard, demo };
inline constexpr std::array<std::string_view, 4> kPresetNames = {"easy", "standard", "hard", "demo"};

/// A synthetic survey in numbers. Ranges are drawn from evenly.
struct SurveyParams {
  Preset preset = Preset::standard;
  int seed = 1;
  int observations = 3;
  int pings = 120;  ///< in each observation
  int schools = 5;  ///< in each observation
  double speed_knots = 6.0;
  double ping_interval_s = 5.0;
  double gap_s = 600.0;  ///< between observations
  double length_min_m = 20.0;
  double length_max_m = 80.0;
  double height_min_m = 5.0;
  double height_max_m = 20.0;
  double range_min_m = 80.0;  ///< slant, when abeam
  double range_max_m = 400.0;
  double above_seabed_min_m = 0.0;  ///< of the schools' lower ends where they keep to the seabed ...
  double above_seabed_max_m = 0.0;  ///< ... that is, where this is not 0
  double sv_min_db = -50.0;         ///< of the core
  double sv_max_db = -35.0;
  double above_background_db = 10.0;  ///< a school's core is at least this much above the background
  double own_speed_min_mps = 0.2;
  double own_speed_max_mps = 1.5;
  double raggedness = 0.15;
  int nuclei = 3;
  double nucleus_db = 6.0;
  int vacuoles = 1;
  int crossings = 0;        ///< pairs of schools in an observation that cross in view
  int splits = 0;           ///< schools in an observation that split in view
  double motion_deg = 1.0;  ///< amplitude of yaw; roll 3 and pitch 1 times this
  BeamPattern beam_pattern = BeamPattern::gaussian;
  double file_mb = 100.0;  ///< a new file begins after this many megabytes
  bool new_file_per_observation = true;
  Water water;
  Noise noise;
};

template <class Visitor>
void describe(Visitor& v, SurveyParams& p) {
  v.choice("preset", p.preset, kPresetNames,
           {"What the survey is like: easy has little noise, hard has schools that cross and split in strong noise, "
            "demo is the tutorial's.",
            Tier::basic});
  v.field("seed", p.seed,
          {.min = 0,
           .max = 2147483647,
           .text = "Seed of every random number; change it for another survey of the same kind.",
           .tier = Tier::basic});
  v.field("observations", p.observations,
          {.min = 1, .max = 1000, .text = "Number of observations.", .tier = Tier::basic});
  v.field("pings", p.pings,
          {.min = 1, .max = 100000, .text = "Number of pings in each observation.", .tier = Tier::basic});
  v.field("schools", p.schools,
          {.min = 0, .max = 500, .text = "Number of schools in each observation.", .tier = Tier::basic});
  v.field("speed_knots", p.speed_knots,
          {.unit = "kn", .min = 0, .max = 25, .text = "The ship's speed over ground.", .tier = Tier::basic});
  v.field("ping_interval_s", p.ping_interval_s, {.unit = "s", .min = 1, .max = 60, .text = "Time between pings."});
  v.field("gap_s", p.gap_s, {.unit = "s", .min = 121, .max = 86400, .text = "Time between observations."});
  v.field("length_min_m", p.length_min_m, {.unit = "m", .min = 5, .max = 300, .text = "Shortest school."});
  v.field("length_max_m", p.length_max_m, {.unit = "m", .min = 5, .max = 300, .text = "Longest school."});
  v.field("height_min_m", p.height_min_m, {.unit = "m", .min = 2, .max = 100, .text = "Lowest height of a school."});
  v.field("height_max_m", p.height_max_m, {.unit = "m", .min = 2, .max = 100, .text = "Greatest height of a school."});
  v.field("range_min_m", p.range_min_m,
          {.unit = "m", .min = 20, .max = 490, .text = "Range of the nearest school when it is abeam."});
  v.field("range_max_m", p.range_max_m,
          {.unit = "m", .min = 20, .max = 490, .text = "Range of the farthest school when it is abeam."});
  v.field("above_seabed_min_m", p.above_seabed_min_m,
          {.unit = "m",
           .min = 0,
           .max = 200,
           .text = "Least height of a school's lower end above the seabed, for schools that keep to it."});
  v.field("above_seabed_max_m", p.above_seabed_max_m,
          {.unit = "m",
           .min = 0,
           .max = 200,
           .text = "Greatest height of a school's lower end above the seabed, for schools that keep to it; 0 puts "
                   "schools anywhere in the upper water."});
  v.field("sv_min_db", p.sv_min_db,
          {.unit = "dB re 1 m-1", .min = -90, .max = -10, .text = "Sv of the weakest school's core."});
  v.field("sv_max_db", p.sv_max_db,
          {.unit = "dB re 1 m-1", .min = -90, .max = -10, .text = "Sv of the strongest school's core."});
  v.field("above_background_db", p.above_background_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "The core of every school is at least this much above the background."});
  v.field("own_speed_min_mps", p.own_speed_min_mps,
          {.unit = "m/s", .min = 0, .max = 5, .text = "Speed of the slowest school."});
  v.field("own_speed_max_mps", p.own_speed_max_mps,
          {.unit = "m/s", .min = 0, .max = 5, .text = "Speed of the fastest school."});
  v.field("raggedness", p.raggedness,
          {.unit = "1",
           .min = 0,
           .max = 0.5,
           .text = "How far a school's boundary wanders, as a share of its half axes; 0 makes ellipsoids."});
  v.field("nuclei", p.nuclei, {.min = 0, .max = 20, .text = "Number of dense nuclei in a school."});
  v.field("nucleus_db", p.nucleus_db,
          {.unit = "dB", .min = 0, .max = 20, .text = "Most that a nucleus exceeds the school around it."});
  v.field("vacuoles", p.vacuoles, {.min = 0, .max = 20, .text = "Number of vacuoles (holes) in a school."});
  v.field("crossings", p.crossings,
          {.min = 0, .max = 20, .text = "Number of pairs of schools that cross in each observation."});
  v.field("splits", p.splits, {.min = 0, .max = 20, .text = "Number of schools that split in each observation."});
  v.field("motion_deg", p.motion_deg,
          {.unit = "deg",
           .min = 0,
           .max = 10,
           .text = "Amplitude of yaw; roll is three times this. Raise it for a rough sea."});
  v.choice("beam_pattern", p.beam_pattern, kBeamPatternNames,
           "Two-way directivity of the beams: a Gaussian, that of a uniform line array with its side lobes, or beams "
           "that send wider than they receive, both ways or along the fan alone.");
  v.field("file_mb", p.file_mb, {.unit = "MB", .min = 1, .max = 4000, .text = "A new file begins after this much."});
  v.field("new_file_per_observation", p.new_file_per_observation, {.text = "Begin a new file with each observation."});
  v.group("water", p.water, "what is in the water besides fish");
  v.group("noise", p.noise, "what the sonar adds");
}

[[nodiscard]] SurveyParams survey_params(Preset preset);

/// The scenes of a survey, one an observation, in time order.
/// errors  bad_parameter: a field out of range, or a range upside down
[[nodiscard]] Result<std::vector<Scene>> survey_scenes(const SurveyParams& params, const std::vector<Beam>& beams);

}  // namespace sonar::synth
