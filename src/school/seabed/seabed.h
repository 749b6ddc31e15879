// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/describe.h"
#include "base/sample_flags.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "school/detect/noise_level.h"

namespace sonar {

struct SeabedParams {
  bool enabled = true;
  double level_db = -60.0;
  double above_background_db = 2.0;
  double min_echo_m = 10.0;
  double rise_db = 4.0;
  double max_slope_deg = 20.0;
  double inlier_m = 6.0;
  double inlier_share = 0.06;
  double min_coverage = 0.6;
  int min_inliers = 20;
  double margin_m = 5.0;
  bool hills = true;
  double hill_step_m = 10.0;

  static constexpr double visible_db =
      3.0;  ///< dB, beams need not agree where Lambert's law brings its peak less far above both
  static constexpr double onset_db = -60.0;  ///< dB re 1 m-1, the echo is followed towards the sonar down to this
  static constexpr double edge_widths =
      1.4;  ///< beams see the seabed this many vertical beam widths below their axis, not more
  static constexpr double unknown_width_deg = 5.7;  ///< deg, ... each so wide where the file tells none
  static constexpr double near_peak_db =
      2.0;  ///< dB, the seabed lies on the beam's axis in the middle of what is so near to the peak
  static constexpr double before_share = 0.25;  ///< the rise is judged so far before the echo, as a share of it ...
  static constexpr int before_samples = 4;      ///< samples, ... or at least so far
  static constexpr double record_end_share = 0.025;  ///< an echo at its peak in this last share of the samples is cut
  static constexpr int record_end_samples = 2;       ///< samples, ... or in so many at least
  static constexpr double whole_fan_share = 0.9;     ///< no school fills so large a share of a fan at one depth
  static constexpr double reach_share = 0.9;         ///< beams should see the plane within this share of their range
  static constexpr double min_dip =
      0.3;  ///< sine of the depression of the flattest beams that should: others see a faint ramp
  static constexpr double onset_gap_m = 4.0;  ///< m, a quiet stretch of this length ends the echo
  static constexpr double hill_behind_db =
      8.0;  ///< dB, a beam that hears the plane at most so far below what it should ends there, not at a hill
  static constexpr double hill_dip_db = 3.0;  ///< dB, ... as an echo that rises so far out of the one before it
  static constexpr int hill_gap_beams =
      1;  ///< beams, beams one above the other in which the seabed may be too faint; above more there is none
  static constexpr int planes = 3;       ///< so many are looked for until one is seen where it should be
  static constexpr int trials = 300;     ///< planes tried; every third is level
  static constexpr int refinements = 5;  ///< least-squares fits of the best plane at most
  static constexpr double fit_spreads =
      7.0;  ///< ... in which echoes farther off than so many times their median distance have no say
  static constexpr double fit_least_share =
      0.2;                                    ///< ... if they are farther off than this share of what an inlier may be
  static constexpr double fit_support = 0.9;  ///< ... a fit that loses more than the rest of the beams is not taken
  /// ... but where their median distance is a larger share of what an inlier may be, none may be lost: hills. Below it the
  /// seabed is smooth, and no echo in its beam-edge echo is a hill.
  static constexpr double fit_smooth_share = 0.243;
  static constexpr double min_triangle_m2 = 25.0;  ///< m2, three echoes on less tell no slope (twice the area)
};

template <class Visitor>
void describe(Visitor& v, SeabedParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Find the seabed and leave it out; switch it off in water too deep for the beams to reach it."});
  v.field(
      "level_db", p.level_db,
      {.unit = "dB re 1 m-1", .min = -100, .max = 0, .text = "Lowest Sv of a seabed echo; lower it over soft mud."});
  v.field("above_background_db", p.above_background_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "Least level of a seabed echo above the background noise of its beam; raise it if noise is taken "
                   "for the seabed, lower it where a faint seabed is missed."});
  v.field("min_echo_m", p.min_echo_m,
          {.unit = "m",
           .min = 0,
           .max = 500,
           .text = "Least extent of a seabed echo along range; lower it for steep beams."});
  v.field(
      "rise_db", p.rise_db,
      {.unit = "dB",
       .min = 0,
       .max = 60,
       .text = "The peak of a seabed echo lies at least this much above the level shortly before the echo; raise it if "
               "layers of fish are taken for the seabed, lower it where a seabed that sets in softly is missed."});
  v.field("max_slope_deg", p.max_slope_deg,
          {.unit = "deg",
           .min = 0,
           .max = 60,
           .text = "Steepest seabed that is believed; raise it at the shelf edge or in fjords."});
  v.field("inlier_m", p.inlier_m,
          {.unit = "m",
           .min = 0,
           .max = 100,
           .text = "An echo within this depth of the plane fitted to the seabed belongs to the seabed; raise it over "
                   "rough seabed."});
  v.field("inlier_share", p.inlier_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "An echo belongs to the seabed if it lies within this share of its slant range, in depth, of the "
                   "plane fitted to the seabed; raise it over rough seabed at long range."});
  v.field("min_coverage", p.min_coverage,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "Least share of the beams expected to show the seabed that must show it; raise it if layers of fish "
                   "are taken for the seabed, lower it where the seabed is missed."});
  v.field("min_inliers", p.min_inliers,
          {.unit = "beams",
           .min = 3,
           .max = 100000,
           .text = "Least number of beams that must show the seabed for it to be found; lower it where only few beams "
                   "reach the seabed, raise it if schools are taken for it."});
  v.field("margin_m", p.margin_m,
          {.unit = "m",
           .min = 0,
           .max = 200,
           .text = "Height above the seabed up to which water is left out; lower it for schools close to the seabed, "
                   "raise it if seabed echo remains.",
           .tier = Tier::basic});
  v.field("hills", p.hills,
          {.text = "Take hills above the plane fitted to the seabed as seabed where beams end at them; over a smooth "
                   "seabed, beam-edge seabed echo is no hill. Switch it off over flat seabed."});
  v.field("hill_step_m", p.hill_step_m,
          {.unit = "m",
           .min = 0,
           .max = 500,
           .text = "An echo is no hill if a lower beam of its azimuth sees the seabed farther away by more than this; "
                   "raise it where steep hills are missed, lower it if schools are taken for hills."});
}

/// The seabed of one ping: a plane in the sonar frame, z = offset_m + slope_x x + slope_y y (z down).
struct Seabed {
  bool found = false;
  double offset_m = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
  double confidence = 0.0;   ///< share of the beams that should see it and do
  double roughness_m = 0.0;  ///< standard deviation of its depth about the plane
  double min_x = 0.0;        ///< where it was seen, m
  double max_x = 0.0;
  double min_y = 0.0;
  double max_y = 0.0;
  std::vector<std::int32_t> first_sample;  ///< [row] first sample beyond seabed - margin; the sample count = none
  std::vector<std::int32_t>
      heard_sample;  ///< [row] the same, with the beam-edge echo, which comes earlier; empty = alike
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

/// Sets SampleFlags::seabed from heard_sample to the end of each row, where something was recorded: nothing grows in there,
/// and pictures leave it out.
void flag_seabed(const Seabed& seabed, View3<SampleFlags> flags);
/// The same from first_sample: detection and measuring know the beam-edge echo as the water's own.
void flag_seabed_itself(const Seabed& seabed, View3<SampleFlags> flags);

/// Depth of the seabed under a place, below the water line; NaN where none was seen near there.
/// beyond_share, beyond_m  how far beyond the seen area it is believed: a share of its extent, and so much more
[[nodiscard]] double bottom_depth_m(const Seabed& seabed, const Point<Sonar>& place, const Placement& placement,
                                    double beyond_share, double beyond_m);

}  // namespace sonar
