// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"

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
                   "off to take every school as evenly dense."});
  v.field("density_looks", p.density_looks,
          {.unit = "1",
           .min = 0,
           .max = 1000000,
           .text = "An even density weighs as much as this many members, each a pulse long; raise it if corrected "
                   "sizes scatter from school to school."});
  v.field("reach_fans", p.reach_fans,
          {.unit = "fans", .min = 0, .max = 100, .text = "Corrected sizes use echo this many fans beyond the mask."});
  v.field("reach_beams", p.reach_beams,
          {.unit = "beams", .min = 0, .max = 100, .text = "Corrected sizes use echo this many beams beyond the mask."});
  v.field("reach_samples", p.reach_samples,
          {.unit = "samples",
           .min = 0,
           .max = 1000,
           .text = "Corrected sizes use echo this many samples beyond the mask."});
  v.field("others_beams", p.others_beams,
          {.unit = "beams",
           .min = 0,
           .max = 100,
           .text = "Echo within this many beams of another school is not taken as background, nor is echo within "
                   "reach_samples before and behind it."});
  v.field("min_extent_m", p.min_extent_m,
          {.unit = "m",
           .min = 0.01,
           .max = 100,
           .text = "A corrected extent below this is left empty, because beam and pulse hide it."});
  v.field("ring_gap_samples", p.ring_gap_samples,
          {.unit = "samples",
           .min = 0,
           .max = 10000,
           .text = "Gap between the echo used for sizes and the water from which the local background is taken, before "
                   "and behind."});
  v.field("ring_samples", p.ring_samples,
          {.unit = "samples",
           .min = 1,
           .max = 10000,
           .text = "Length of the water before and behind from which the local background is taken."});
  v.field(
      "min_ring_samples", p.min_ring_samples,
      {.unit = "samples",
       .min = 1,
       .max = 100000,
       .text = "Fans with fewer sound samples in that water keep the background as estimated from the whole beam."});
  v.field("max_ring_factor", p.max_ring_factor,
          {.unit = "1",
           .min = 1,
           .max = 100,
           .text = "Largest ratio of local and estimated background, either way; raise it where the water's own echo "
                   "varies strongly."});
  v.field("min_fan_share", p.min_fan_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "A fan counts for the height where at least this share of its echo is heard, and not hidden by "
                   "faults or borders."});
  v.field("find_beam_shape", p.find_beam_shape,
          {.text = "Find the shape of beam that fits all schools of an observation best; switch it off to use "
                   "beam_gaussian_share."});
  v.field("beam_shapes", p.beam_shapes,
          {.unit = "1",
           .min = 2,
           .max = 100,
           .text = "How many shapes of beam are tried, evenly spaced from a uniform line array's to a Gaussian."});
  v.field("beam_gaussian_share", p.beam_gaussian_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "Shape of the beam's skirts: 1 is a Gaussian (a shaded array), 0 a uniform line array's, values "
                   "between are a mean. Set it where the array's shading is known."});
  v.field("use_beam_angle", p.use_beam_angle,
          {.text = "Tell from the file's equivalent beam angles how much wider the sonar sends than it receives; "
                   "switch it off where the stated angles are known to be wrong."});
  v.field("beam_angle_least_db", p.beam_angle_least_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "Equivalent beam angles that differ by less than this from what the -3 dB widths give, or by so "
                   "much more than is possible, are taken as rounded."});
  v.field("beam_angle_spread_db", p.beam_angle_spread_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "Equivalent beam angles that differ by more than this over the sector, ripple removed, are taken as "
                   "copied from one beam to all."});
  v.field("beam_angle_ripple_db", p.beam_angle_ripple_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "Equivalent beam angles with more ripple from beam to beam than this are not believed; transmit "
                   "fans have 0.5 to 2.4 dB from crest to trough."});
  v.field("alike_evidence", p.alike_evidence,
          {.unit = "1",
           .min = 0,
           .max = 1000,
           .text = "Log-likelihood by which schools must favour a sonar that sends wider both ways over one that sends "
                   "wider along the fan alone."});
  v.field("beam_pedestal", p.beam_pedestal,
          {.unit = "1",
           .min = 0.0001,
           .max = 10,
           .text = "Share of the strongest fan's echo below which the beam's skirts have no say in the height; raise "
                   "it where side lobes are high."});
  v.field("height_pool_pings", p.height_pool_pings,
          {.unit = "pings",
           .min = 0,
           .max = 10000,
           .text = "How many pings before and after have a say in a school's corrected height; 0 measures each ping on "
                   "its own."});
  v.field("min_height_evidence", p.min_height_evidence,
          {.unit = "1",
           .min = 0,
           .max = 1000,
           .text = "A height is left empty where its log-likelihood exceeds that of a flat school by less than this."});
  v.field("min_level_share", p.min_level_share,
          {.unit = "1",
           .min = 0,
           .max = 10,
           .text = "A length or width is left empty where the school's variance is a smaller share of the beam's and "
                   "the pulse's than this."});
  v.field("seabed_beyond_share", p.seabed_beyond_share,
          {.unit = "1",
           .min = 0,
           .max = 10,
           .text = "How far beyond the area in which it was seen the seabed's plane is believed, as a share of that "
                   "area's extent; raise it over flat ground."});
  v.field("seabed_beyond_m", p.seabed_beyond_m,
          {.unit = "m",
           .min = 0,
           .max = 10000,
           .text = "How much farther, beside that share, the seabed's plane is believed beyond the area in which it "
                   "was seen."});
}

}  // namespace sonar
