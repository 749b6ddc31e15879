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
  double floor_extent_m = 1.0;
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
  double bottom_beyond_share = 0.3;
  double bottom_beyond_m = 20.0;
};

template <class Visitor>
void describe(Visitor& v, MeasureParams& p) {
  v.field("shape_variance", p.shape_variance,
          {.unit = "1",
           .min = 1,
           .max = 12,
           .text = "extent = 2 sqrt(this x variance): 5 for a uniform ellipsoid, 3 for a box"});
  v.field("find_density", p.find_density,
          {.text = "the echo along each axis tells how dense a school's heart is beside its rim; off = evenly"});
  v.field("density_looks", p.density_looks,
          {.unit = "1",
           .min = 0,
           .max = 1000000,
           .text = "... an even density has as much say as so many members, each a pulse long"});
  v.field("reach_fans", p.reach_fans,
          {.unit = "fans", .min = 0, .max = 100, .text = "corrected sizes use echo so far beyond the mask"});
  v.field("reach_beams", p.reach_beams,
          {.unit = "beams", .min = 0, .max = 100, .text = "corrected sizes use echo so far beyond the mask"});
  v.field("reach_samples", p.reach_samples,
          {.unit = "samples", .min = 0, .max = 1000, .text = "corrected sizes use echo so far beyond the mask"});
  v.field("others_beams", p.others_beams,
          {.unit = "beams",
           .min = 0,
           .max = 100,
           .text = "the echo so far beside another school is no background; reach_samples before and behind it"});
  v.field("floor_extent_m", p.floor_extent_m,
          {.unit = "m", .min = 0.01, .max = 100, .text = "a smaller corrected extent is not told"});
  v.field("ring_gap_samples", p.ring_gap_samples,
          {.unit = "samples",
           .min = 0,
           .max = 10000,
           .text = "the local background is taken from so far before and behind that echo"});
  v.field("ring_samples", p.ring_samples,
          {.unit = "samples", .min = 1, .max = 10000, .text = "over this length on either side"});
  v.field("min_ring_samples", p.min_ring_samples,
          {.unit = "samples", .min = 1, .max = 100000, .text = "fewer sound samples in a fan leave it as estimated"});
  v.field("max_ring_factor", p.max_ring_factor,
          {.unit = "1", .min = 1, .max = 100, .text = "largest ratio of local and estimated background, either way"});
  v.field("min_fan_share", p.min_fan_share,
          {.unit = "1", .min = 0, .max = 1, .text = "fans count for the height where this share of the echo is heard"});
  v.field("find_beam_shape", p.find_beam_shape,
          {.text = "the shape of beam that fits all schools of an observation best; off = as beam_gaussian_share"});
  v.field(
      "beam_shapes", p.beam_shapes,
      {.unit = "1", .min = 2, .max = 100, .text = "... of so many, evenly spaced from a uniform line to a Gaussian"});
  v.field("beam_gaussian_share", p.beam_gaussian_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "the beam's flanks: 1 = Gaussian (a shaded array), 0 = a uniform line array's, between = a mean"});
  v.field("use_beam_angle", p.use_beam_angle,
          {.text = "the file's equivalent beam angles tell how much wider than it receives the sonar sends"});
  v.field("beam_angle_least_db", p.beam_angle_least_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "... where they differ by this from what the widths give; so much more than can be is rounding"});
  v.field(
      "beam_angle_spread_db", p.beam_angle_spread_db,
      {.unit = "dB",
       .min = 0,
       .max = 60,
       .text = "... and by no more over the sector, ripple from beam to beam smoothed: angles copied from one to all "
               "tell nothing"});
  v.field("beam_angle_ripple_db", p.beam_angle_ripple_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "... whose ripple is no more either way: a transmit fan's is 0.5 to 2.4 dB from crest to trough"});
  v.field("alike_evidence", p.alike_evidence,
          {.unit = "1",
           .min = 0,
           .max = 1000,
           .text = "it sends wider along the fan, or both ways alike where that is likelier by this log-likelihood"});
  v.field("beam_pedestal", p.beam_pedestal,
          {.unit = "1",
           .min = 0.0001,
           .max = 10,
           .text = "share of the strongest fan below which the flanks of the beam decide nothing about the height"});
  v.field("height_pool_pings", p.height_pool_pings,
          {.unit = "pings",
           .min = 0,
           .max = 10000,
           .text = "so many pings before and after have their say in a school's corrected height; 0 = each its own"});
  v.field("min_height_evidence", p.min_height_evidence,
          {.unit = "1",
           .min = 0,
           .max = 1000,
           .text = "no height where its log-likelihood exceeds that of a flat body by less"});
  v.field("min_level_share", p.min_level_share,
          {.unit = "1",
           .min = 0,
           .max = 10,
           .text = "no length or width where the body's variance is a smaller share of the beam's and the pulse's"});
  v.field("bottom_beyond_share", p.bottom_beyond_share,
          {.unit = "1", .min = 0, .max = 10, .text = "the seabed's plane holds so far beyond where it was seen ..."});
  v.field("bottom_beyond_m", p.bottom_beyond_m,
          {.unit = "m", .min = 0, .max = 10000, .text = "... as a share of that area's extent, and this more"});
}

}  // namespace sonar
