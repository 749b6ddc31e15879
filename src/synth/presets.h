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
  double current_east_mps = 0.0;
  double current_north_mps = 0.0;
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
           {"What the survey is like. Choose easy for little noise, hard to test schools that cross and split in "
            "strong noise, demo for the tutorial, standard for anything between.",
            Tier::basic});
  v.field("seed", p.seed,
          {.min = 0,
           .max = 2147483647,
           .text = "Seed of every random number; change it for another survey of the same kind.",
           .tier = Tier::basic});
  v.field("observations", p.observations,
          {.min = 1,
           .max = 1000,
           .text = "Number of observations. Raise it for a longer survey, whose results rest on more schools; lower it "
                   "for a quick trial. The demo always has three.",
           .tier = Tier::basic});
  v.field("pings", p.pings,
          {.min = 1,
           .max = 100000,
           .text = "Number of pings in each observation. Raise it for longer tracks and more room for schools; lower "
                   "it for a quick trial.",
           .tier = Tier::basic});
  v.field("schools", p.schools,
          {.min = 0,
           .max = 500,
           .text = "Number of schools in each observation. Raise it to test crowded water; set it to 0 for a survey in "
                   "which every detection is false.",
           .tier = Tier::basic});
  v.field("speed_knots", p.speed_knots,
          {.unit = "kn",
           .min = 0,
           .max = 25,
           .text = "The ship's speed over ground. Raise it to test tracks of schools that are seen in few pings; lower "
                   "it for more pings of each school.",
           .tier = Tier::basic});
  v.field("ping_interval_s", p.ping_interval_s,
          {.unit = "s",
           .min = 1,
           .max = 60,
           .text = "Time between pings. Raise it to test tracks of schools that are seen in few pings and move far "
                   "between them."});
  v.field("gap_s", p.gap_s,
          {.unit = "s",
           .min = 121,
           .max = 86400,
           .text = "Time without pings between two observations. Lower it to test that short gaps, too, divide a "
                   "survey into observations."});
  v.field("length_min_m", p.length_min_m,
          {.unit = "m",
           .min = 5,
           .max = 300,
           .text = "Length of the shortest school. Lower it to test whether schools smaller than a beam is wide are "
                   "detected, and whether their size is corrected well."});
  v.field("length_max_m", p.length_max_m,
          {.unit = "m",
           .min = 5,
           .max = 300,
           .text = "Length of the longest school. Raise it to test large schools, which the border of the sector cuts "
                   "in many pings."});
  v.field("height_min_m", p.height_min_m,
          {.unit = "m",
           .min = 2,
           .max = 100,
           .text = "Least height of a school, from its top to its lower end. Lower it to test flat schools, "
                   "whose height a beam cannot resolve."});
  v.field("height_max_m", p.height_max_m,
          {.unit = "m",
           .min = 2,
           .max = 100,
           .text = "Greatest height of a school, from its top to its lower end. Raise it to test schools that extend "
                   "over many fans."});
  v.field("range_min_m", p.range_min_m,
          {.unit = "m",
           .min = 20,
           .max = 490,
           .text = "Range of the nearest school when it is abeam. Lower it to test schools close to the ship, of which "
                   "the sector holds only a part."});
  v.field("range_max_m", p.range_max_m,
          {.unit = "m",
           .min = 20,
           .max = 490,
           .text = "Range of the farthest school when it is abeam. Raise it to test far schools, where beams are wide "
                   "and signal-to-noise is low."});
  v.field("above_seabed_min_m", p.above_seabed_min_m,
          {.unit = "m",
           .min = 0,
           .max = 200,
           .text = "Least height of a school's lower end above the seabed, for schools that keep to it. Set it to 0 to "
                   "test schools that touch the seabed; raise it to keep them clear."});
  v.field("above_seabed_max_m", p.above_seabed_max_m,
          {.unit = "m",
           .min = 0,
           .max = 200,
           .text = "Greatest height of a school's lower end above the seabed. Raise it from 0 to test schools that "
                   "keep to the seabed; at 0 they lie anywhere in the upper water."});
  v.field("sv_min_db", p.sv_min_db,
          {.unit = "dB re 1 m-1",
           .min = -90,
           .max = -10,
           .text = "Sv in the core of the weakest school. Lower it, with above_background_db, to test how weak a "
                   "school may be and still be detected."});
  v.field("sv_max_db", p.sv_max_db,
          {.unit = "dB re 1 m-1",
           .min = -90,
           .max = -10,
           .text = "Sv in the core of the strongest school. Raise it to test very dense schools; lower it for a survey "
                   "of weak schools alone."});
  v.field("above_background_db", p.above_background_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "How far the core of every school is above the background at least. Lower it to test schools that "
                   "can hardly be detected; raise it for schools that stay clear."});
  v.field("own_speed_min_mps", p.own_speed_min_mps,
          {.unit = "m s-1",
           .min = 0,
           .max = 5,
           .text = "Speed of the slowest school. Set it to 0 to have schools that hardly move; raise it to test tracks "
                   "of fast schools alone."});
  v.field("own_speed_max_mps", p.own_speed_max_mps,
          {.unit = "m s-1",
           .min = 0,
           .max = 5,
           .text = "Speed of the fastest school. Raise it to test tracks of schools that move far between pings; set "
                   "it and own_speed_min_mps to 0 for schools that stand still."});
  v.field("current_east_mps", p.current_east_mps,
          {.unit = "m s-1",
           .min = -3,
           .max = 3,
           .text = "Eastward velocity of the water, which carries all schools beside their own speed. Set it to test "
                   "speeds through the water."});
  v.field("current_north_mps", p.current_north_mps,
          {.unit = "m s-1", .min = -3, .max = 3, .text = "Northward velocity of the water; see current_east_mps."});
  v.field("raggedness", p.raggedness,
          {.unit = "1",
           .min = 0,
           .max = 0.5,
           .text = "How far a school's boundary departs from an ellipsoid, as a share of its half axes. Raise it to "
                   "test irregular schools; set it to 0 for plain ellipsoids."});
  v.field("nuclei", p.nuclei,
          {.min = 0,
           .max = 20,
           .text = "Number of nuclei in a school: lumps denser than the rest. Raise it to test schools of uneven "
                   "density; set it to 0 for even ones."});
  v.field("nucleus_db", p.nucleus_db,
          {.unit = "dB",
           .min = 0,
           .max = 20,
           .text = "Most that a nucleus exceeds the school around it. Raise it to test whether a school with strong "
                   "nuclei is detected as one school or as several."});
  v.field("vacuoles", p.vacuoles,
          {.min = 0,
           .max = 20,
           .text = "Number of vacuoles (holes) in a school. Raise it to test whether masks leave out holes; set it to "
                   "0 for schools without any."});
  v.field("crossings", p.crossings,
          {.min = 0,
           .max = 20,
           .text = "Number of pairs of schools that cross in view in each observation. Raise it to test whether tracks "
                   "keep the two apart."});
  v.field("splits", p.splits,
          {.min = 0,
           .max = 20,
           .text = "Number of schools that split in view in each observation. Raise it to test what tracks do when one "
                   "school becomes two."});
  v.field("motion_deg", p.motion_deg,
          {.unit = "deg",
           .min = 0,
           .max = 10,
           .text = "Amplitude of the ship's yaw and pitch; roll is three times this. Raise it for a rough sea; set it "
                   "to 0 for a ship that does not move with the waves."});
  v.choice("beam_pattern", p.beam_pattern, kBeamPatternNames,
           "Two-way beam pattern: Gaussian, uniform line array with side lobes, or sending wider than receiving (both "
           "ways, or along the fan). Change it to test what beam shape does to results.");
  v.field("file_mb", p.file_mb,
          {.unit = "MB",
           .min = 1,
           .max = 4000,
           .text = "Size at which a new raw file begins. Lower it to test schools that are seen across the border of "
                   "two raw files."});
  v.field("new_file_per_observation", p.new_file_per_observation,
          {.text = "Whether each observation begins a new raw file. Turn it off to test that a raw file which holds "
                   "several observations is divided."});
  v.group("water", p.water, "what is in the water besides fish");
  v.group("noise", p.noise, "what the sonar adds");
}

[[nodiscard]] SurveyParams survey_params(Preset preset);

/// The scenes of a survey, one an observation, in time order.
/// errors  bad_parameter: a field out of range, or a range upside down
[[nodiscard]] Result<std::vector<Scene>> survey_scenes(const SurveyParams& params, const std::vector<Beam>& beams);

}  // namespace sonar::synth
