// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/describe.h"
#include "base/sample_flags.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "school/background.h"

namespace sonar {

struct SeabedParams {
  bool enabled = true;
  double level_db = -60.0;
  double above_background_db = 2.0;
  double visible_db = 3.0;
  double min_echo_m = 10.0;
  double rise_db = 4.0;
  double max_slope_deg = 20.0;
  double inlier_m = 6.0;
  double inlier_share = 0.06;
  double min_coverage = 0.6;
  int min_inliers = 20;
  double onset_db = -60.0;
  double edge_widths = 1.4;
  double unknown_width_deg = 5.7;
  double margin_m = 5.0;
  double near_peak_db = 2.0;
  double before_share = 0.25;
  int before_samples = 4;
  double record_end_share = 0.025;
  int record_end_samples = 2;
  double whole_fan_share = 0.9;
  double reach_share = 0.9;
  double min_dip = 0.3;
  double onset_gap_m = 4.0;
  bool hills = true;
  double hill_step_m = 10.0;
  double hill_behind_db = 8.0;
  double hill_dip_db = 3.0;
  int hill_gap_beams = 1;
  int planes = 3;
  int trials = 300;
  int refinements = 5;
  double fit_spreads = 7.0;
  double fit_least_share = 0.2;
  double fit_support = 0.9;
  double fit_smooth_share = 0.243;
  double min_triangle_m2 = 25.0;
};

template <class Visitor>
void describe(Visitor& v, SeabedParams& p) {
  v.field("enabled", p.enabled, {.text = "look for the seabed at all"});
  v.field("level_db", p.level_db, {.unit = "dB re 1 m-1", .min = -100, .max = 0, .text = "lowest Sv of a seabed echo"});
  v.field("above_background_db", p.above_background_db,
          {.unit = "dB", .min = 0, .max = 60, .text = "its echo stands so far above the background too"});
  v.field("visible_db", p.visible_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "beams need not agree where Lambert's law brings its peak less far above both"});
  v.field("min_echo_m", p.min_echo_m, {.unit = "m", .min = 0, .max = 500, .text = "its least extent along range"});
  v.field("rise_db", p.rise_db,
          {.unit = "dB", .min = 0, .max = 60, .text = "its peak stands so far above what lies before it"});
  v.field("max_slope_deg", p.max_slope_deg, {.unit = "deg", .min = 0, .max = 60, .text = "steepest seabed believed"});
  v.field("inlier_m", p.inlier_m,
          {.unit = "m", .min = 0, .max = 100, .text = "an echo this near to the plane in depth belongs to it"});
  v.field("inlier_share", p.inlier_share,
          {.unit = "1", .min = 0, .max = 1, .text = "the same, as a share of the slant range"});
  v.field("min_coverage", p.min_coverage,
          {.unit = "1", .min = 0, .max = 1, .text = "share of the beams that should see the plane and do"});
  v.field("min_inliers", p.min_inliers, {.unit = "beams", .min = 3, .max = 100000, .text = "least number of beams"});
  v.field(
      "onset_db", p.onset_db,
      {.unit = "dB re 1 m-1", .min = -120, .max = 0, .text = "the echo is followed towards the sonar down to this"});
  v.field("edge_widths", p.edge_widths,
          {.unit = "1",
           .min = 0,
           .max = 5,
           .text = "beams see the seabed this many vertical beam widths below their axis, not more"});
  v.field("unknown_width_deg", p.unknown_width_deg,
          {.unit = "deg", .min = 0.1, .max = 90, .text = "... each so wide where the file tells none"});
  v.field("margin_m", p.margin_m, {.unit = "m", .min = 0, .max = 200, .text = "water above the seabed left out"});
  v.field("near_peak_db", p.near_peak_db,
          {.unit = "dB",
           .min = 0,
           .max = 30,
           .text = "the seabed lies on the beam's axis in the middle of what is so near to the peak"});
  v.field("before_share", p.before_share,
          {.unit = "1", .min = 0, .max = 5, .text = "the rise is judged so far before the echo, as a share of it ..."});
  v.field("before_samples", p.before_samples,
          {.unit = "samples", .min = 1, .max = 10000, .text = "... or at least so far"});
  v.field("record_end_share", p.record_end_share,
          {.unit = "1", .min = 0, .max = 0.5, .text = "an echo at its peak in this last share of the samples is cut"});
  v.field("record_end_samples", p.record_end_samples,
          {.unit = "samples", .min = 1, .max = 10000, .text = "... or in so many at least"});
  v.field("whole_fan_share", p.whole_fan_share,
          {.unit = "1", .min = 0, .max = 1, .text = "no school fills so large a share of a fan at one depth"});
  v.field("reach_share", p.reach_share,
          {.unit = "1", .min = 0, .max = 1, .text = "beams should see the plane within this share of their range"});
  v.field("min_dip", p.min_dip,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "sine of the depression of the flattest beams that should: others see a faint ramp"});
  v.field("onset_gap_m", p.onset_gap_m,
          {.unit = "m", .min = 0, .max = 100, .text = "a quiet stretch of this length ends the echo"});
  v.field("hills", p.hills, {.text = "what rises out of the plane is seabed too where beams end at it"});
  v.field("hill_step_m", p.hill_step_m,
          {.unit = "m",
           .min = 0,
           .max = 500,
           .text = "no lower beam of that azimuth sees the seabed so much farther away than the hill"});
  v.field("hill_behind_db", p.hill_behind_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "a beam that hears the plane at most so far below what it should ends there, not at a hill"});
  v.field("hill_dip_db", p.hill_dip_db,
          {.unit = "dB", .min = 0, .max = 60, .text = "... as an echo that rises so far out of the one before it"});
  v.field("hill_gap_beams", p.hill_gap_beams,
          {.unit = "beams",
           .min = 0,
           .max = 1000,
           .text = "beams one above the other in which the ground may be too faint; above more there is none"});
  v.field("planes", p.planes,
          {.unit = "1", .min = 1, .max = 100, .text = "so many are looked for until one is seen where it should be"});
  v.field("trials", p.trials, {.unit = "1", .min = 1, .max = 100000, .text = "planes tried; every third is level"});
  v.field("refinements", p.refinements,
          {.unit = "1", .min = 0, .max = 100, .text = "least-squares fits of the best plane at most"});
  v.field("fit_spreads", p.fit_spreads,
          {.unit = "1",
           .min = 0.1,
           .max = 1000,
           .text = "... in which echoes farther off than so many times their median distance have no say"});
  v.field("fit_least_share", p.fit_least_share,
          {.unit = "1",
           .min = 0.01,
           .max = 1,
           .text = "... if they are farther off than this share of what an inlier may be"});
  v.field(
      "fit_support", p.fit_support,
      {.unit = "1", .min = 0, .max = 1, .text = "... a fit that loses more than the rest of the beams is not taken"});
  v.field(
      "fit_smooth_share", p.fit_smooth_share,
      {.unit = "1",
       .min = 0,
       .max = 1,
       .text =
           "... but where their median distance is a larger share of what an inlier may be, none may be lost: hills"});
  v.field("min_triangle_m2", p.min_triangle_m2,
          {.unit = "m2", .min = 0, .max = 10000, .text = "three echoes on less tell no slope (twice the area)"});
}

/// The seabed of one ping: a plane in the sonar frame, z = offset_m + slope_x x + slope_y y (z down).
struct Seabed {
  bool found = false;
  double offset_m = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
  double confidence = 0.0;  ///< share of the beams that should see it and do
  double min_x = 0.0;       ///< where it was seen, m
  double max_x = 0.0;
  double min_y = 0.0;
  double max_y = 0.0;
  std::vector<std::int32_t> first_sample;  ///< [row] first sample beyond seabed - margin; the sample count = none
};

/// Finds the seabed from this ping alone: echoes per beam, a robust plane in metres, its onset along each beam.
/// sv        [fan][beam][sample], median-filtered Sv counts
/// background  the noise's share of sv: where it is loud, an echo must stand above it
/// vertical_width_deg  [fan][beam] one-way -3 dB, BeamGrid's
/// out       found = false where the beams that would see a plane do not agree on one
/// threads   pure
/// source    reference: robust plane over per-beam candidates
[[nodiscard]] Seabed find_seabed(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                 const Background& background, const Sector& sector,
                                 const std::vector<double>& vertical_width_deg, const SeabedParams& params);

/// Sets SampleFlags::seabed from first_sample to the end of each row, where something was recorded.
void flag_seabed(const Seabed& seabed, View3<SampleFlags> flags);

/// Depth of the seabed under a place, below the water line; NaN where none was seen near there.
/// beyond_share, beyond_m  how far beyond the seen area it is believed: a share of its extent, and so much more
[[nodiscard]] double bottom_depth_m(const Seabed& seabed, const Point<Sonar>& place, const Placement& placement,
                                    double beyond_share, double beyond_m);

}  // namespace sonar
