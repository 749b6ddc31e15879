// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"
#include "model/extinction_params.h"

namespace sonar {

struct MeasureParams {
  double shape_variance = 5.0;
  bool find_density = true;
  double density_looks = 400.0;
  int reach_fans = 2;
  int reach_beams = 1;
  int reach_samples = 6;
  int others_beams = 2;
  double min_extent_m = 1.0;
  int ring_gap_samples = 12;
  int ring_samples = 64;
  int min_ring_samples = 60;
  double max_ring_factor = 4.0;
  double min_fan_share = 0.5;
  bool find_beam_shape = true;
  double beam_gaussian_share = 0.5;
  int beam_shapes = 5;
  bool use_beam_angle = true;
  double beam_angle_least_db = 0.3;
  double beam_angle_spread_db = 1.0;
  double beam_angle_ripple_db = 3.0;
  double alike_evidence = 5.0;
  double beam_pedestal = 0.1;
  int height_pool_pings = 10;
  double min_height_evidence = 0.7;
  double min_level_share = 0.05;
  double seabed_beyond_share = 0.3;
  double seabed_beyond_m = 20.0;
  ExtinctionParams extinction;
};

template <class Visitor>
void describe(Visitor& v, MeasureParams& p) {
  v.field("shape_variance", p.shape_variance,
          {.unit = "1",
           .min = 1,
           .max = 12,
           .text = "A school's extent is 2 sqrt(this times the variance of its echo): 5 for a uniform ellipsoid, 3 for "
                   "a box. Change it where the form of the schools is known."});
  v.field("find_density", p.find_density,
          {.text = "Tell from the echo along each axis how much denser a school's core is than its margin; switch it "
                   "off where schools are known to be evenly dense, to use shape_variance alone."});
  v.field("density_looks", p.density_looks,
          {.unit = "1",
           .min = 0,
           .max = 1000000,
           .text = "Weight of the assumption that a school is evenly dense, as a number of members a pulse long; raise "
                   "it if corrected sizes scatter from school to school, lower it for schools with a dense core."});
  v.field("reach_fans", p.reach_fans,
          {.unit = "fans",
           .min = 0,
           .max = 100,
           .text = "Corrected sizes use echo this many fans beyond the mask; raise it for wide beams, whose skirts "
                   "carry a school's echo far, lower it where other echoes lie above or below."});
  v.field("reach_beams", p.reach_beams,
          {.unit = "beams",
           .min = 0,
           .max = 100,
           .text = "Corrected sizes use echo this many beams beyond the mask; raise it for wide beams, whose skirts "
                   "carry a school's echo far, lower it where other echoes lie beside the school."});
  v.field("reach_samples", p.reach_samples,
          {.unit = "samples",
           .min = 0,
           .max = 1000,
           .text = "Corrected sizes use echo this many samples before and behind the mask; raise it for long pulses or "
                   "faint margins, lower it where other echoes lie close in range."});
  v.field("others_beams", p.others_beams,
          {.unit = "beams",
           .min = 0,
           .max = 100,
           .text = "Echo within this many beams of another school, and within reach_samples before and behind it, is "
                   "not taken as background; raise it where loud schools are heard through side lobes."});
  v.field("min_extent_m", p.min_extent_m,
          {.unit = "m",
           .min = 0.01,
           .max = 100,
           .text = "A corrected extent below this is left empty, because beam and pulse hide it; lower it for small "
                   "schools near the sonar, raise it for wide beams or long pulses."});
  v.field("ring_gap_samples", p.ring_gap_samples,
          {.unit = "samples",
           .min = 0,
           .max = 10000,
           .text = "Gap, before and behind a school, between the echo used for its size and the water that gives its "
                   "local background; raise it for schools with a long, faint margin."});
  v.field("ring_samples", p.ring_samples,
          {.unit = "samples",
           .min = 1,
           .max = 10000,
           .text = "Length of the water before and behind a school that gives its local background; raise it for a "
                   "steadier background, lower it where the background changes quickly with range."});
  v.field(
      "min_ring_samples", p.min_ring_samples,
      {.unit = "samples",
       .min = 1,
       .max = 100000,
       .text = "Fewest usable samples in the water beside a school for a fan's local background, else the estimate "
               "from whole beams stays; lower it where faults or other schools leave few, raise it if sizes scatter."});
  v.field(
      "max_ring_factor", p.max_ring_factor,
      {.unit = "1",
       .min = 1,
       .max = 100,
       .text = "Largest ratio, either way, of the local background beside a school and the estimate from whole beams; "
               "raise it where the water's own echo varies strongly, lower it where weak echoes pass for background."});
  v.field(
      "min_fan_share", p.min_fan_share,
      {.unit = "1",
       .min = 0,
       .max = 1,
       .text = "A fan helps to find a school's height if at least this share of the school's water in it is free of "
               "faults and borders; lower it if faults leave heights empty, raise it if faults distort heights."});
  v.field("find_beam_shape", p.find_beam_shape,
          {.text = "Find the shape of beam that fits all schools of an observation best; switch it off to use "
                   "beam_gaussian_share, where the array's shading is known or schools are few."});
  v.field("beam_shapes", p.beam_shapes,
          {.unit = "1",
           .min = 2,
           .max = 100,
           .text = "How many shapes of beam are tried, evenly spaced from a uniform line array's to a Gaussian; raise "
                   "it for a finer choice, lower it to save time."});
  v.field("beam_gaussian_share", p.beam_gaussian_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "Shape of the beam's skirts while find_beam_shape is off: 1 is a Gaussian (a shaded array), 0 a "
                   "uniform line array's, values between are a mean. Set it where the array's shading is known."});
  v.field("use_beam_angle", p.use_beam_angle,
          {.text = "Tell from the file's equivalent beam angles how much wider the sonar sends than it receives; "
                   "switch it off where the stated angles are known to be wrong."});
  v.field(
      "beam_angle_least_db", p.beam_angle_least_db,
      {.unit = "dB",
       .min = 0,
       .max = 60,
       .text = "Equivalent beam angles are ignored, as rounded, if they exceed what the -3 dB widths give by less than "
               "this, or the most that is possible by more than this; raise it where files round angles coarsely."});
  v.field("beam_angle_spread_db", p.beam_angle_spread_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "Equivalent beam angles are ignored, as copied from one beam to all, if their excess over what the "
                   "-3 dB widths give varies by more than this over the sector, ripple removed; raise it if true "
                   "angles are ignored."});
  v.field(
      "beam_angle_ripple_db", p.beam_angle_ripple_db,
      {.unit = "dB",
       .min = 0,
       .max = 60,
       .text =
           "Equivalent beam angles are ignored if any beam's lies farther than this off their smooth course over the "
           "sector; transmit fans ripple by 0.5 to 2.4 dB from crest to trough. Raise it for a stronger ripple."});
  v.field(
      "alike_evidence", p.alike_evidence,
      {.unit = "1",
       .min = 0,
       .max = 1000,
       .text =
           "Log-likelihood by which schools must favour a transmit beam wider than the receive beam in both directions "
           "over one wider along the fan alone; lower it where the sonar is known to send wider upright too."});
  v.field("beam_pedestal", p.beam_pedestal,
          {.unit = "1",
           .min = 0.0001,
           .max = 10,
           .text = "Share of the strongest fan's echo below which the beam's skirts have no effect on a school's "
                   "height; raise it where side lobes are high, lower it for clean beams."});
  v.field("height_pool_pings", p.height_pool_pings,
          {.unit = "pings",
           .min = 0,
           .max = 10000,
           .text = "How many pings before and after help to find a school's corrected height and density; raise it for "
                   "steadier sizes, lower it for schools that change shape, 0 measures each ping on its own."});
  v.field("min_height_evidence", p.min_height_evidence,
          {.unit = "1",
           .min = 0,
           .max = 1000,
           .text = "A height is left empty where its log-likelihood exceeds that of a flat school by less than this; "
                   "raise it to keep only sure heights, lower it to have more heights of thin or distant schools."});
  v.field("min_level_share", p.min_level_share,
          {.unit = "1",
           .min = 0,
           .max = 10,
           .text = "A length or width is left empty where the school's variance is a smaller share than this of the "
                   "beam's and the pulse's; raise it to keep only sure sizes, lower it for small or distant schools."});
  v.field("seabed_beyond_share", p.seabed_beyond_share,
          {.unit = "1",
           .min = 0,
           .max = 10,
           .text = "How far beyond the area where the seabed was seen its plane still gives a seabed depth, as a share "
                   "of the area's extent; raise it over flat ground, lower it over uneven ground."});
  v.field("seabed_beyond_m", p.seabed_beyond_m,
          {.unit = "m",
           .min = 0,
           .max = 10000,
           .text = "How far beyond the area where the seabed was seen its plane still gives a seabed depth, in "
                   "addition to seabed_beyond_share; raise it over flat ground, lower it over uneven ground."});
  v.group("extinction", p.extinction, "sound that dense schools take out of the beams");
}

}  // namespace sonar
