// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/array.h"
#include "base/describe.h"
#include "base/sample_flags.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "model/beam_grid.h"
#include "model/mask.h"
#include "model/school.h"
#include "school/background.h"
#include "school/seabed.h"

namespace sonar {

struct MeasureParams {
  double shape_variance = 5.0;
  int reach_fans = 2;
  int reach_beams = 1;
  int reach_samples = 6;
  double floor_extent_m = 1.0;
  int ring_gap_samples = 12;
  int ring_samples = 64;
  int min_ring_samples = 60;
  double max_ring_factor = 4.0;
  double min_fan_share = 0.5;
  double beam_gaussian_share = 0.5;
  double beam_pedestal = 0.1;
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
  v.field("reach_fans", p.reach_fans,
          {.unit = "fans", .min = 0, .max = 100, .text = "corrected sizes use echo so far beyond the mask"});
  v.field("reach_beams", p.reach_beams,
          {.unit = "beams", .min = 0, .max = 100, .text = "corrected sizes use echo so far beyond the mask"});
  v.field("reach_samples", p.reach_samples,
          {.unit = "samples", .min = 0, .max = 1000, .text = "corrected sizes use echo so far beyond the mask"});
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
          {.unit = "1", .min = 0, .max = 1, .text = "fans count for the height where this share of the echo is sound"});
  v.field("beam_gaussian_share", p.beam_gaussian_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "the beam's flanks: 1 = Gaussian (a shaded array), 0 = a uniform line array's, between = a mean"});
  v.field("beam_pedestal", p.beam_pedestal,
          {.unit = "1",
           .min = 0.0001,
           .max = 10,
           .text = "share of the strongest fan below which the flanks of the beam decide nothing about the height"});
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

/// What one ping offers for measuring; borrowed.
struct MeasureInput {
  View3<const std::int16_t> sv;        ///< unfiltered Sv counts
  View3<const std::int16_t> filtered;  ///< median-filtered Sv counts: stands in at faulty samples for sizes only
  View3<const SampleFlags> flags;      ///< seabed included
  const Sector* sector = nullptr;
  const BeamGrid* grid = nullptr;
  Background background;
  Placement placement;
  double pulse_m = 0.0;              ///< extent of the pulse along range, c tau / 2
  const Seabed* seabed = nullptr;    ///< null = none seen
  const PingMask* others = nullptr;  ///< voxels of all other schools of the ping; null = none
  double threshold_db = kUnknown;    ///< the mask's, for the record
};

/// Which members are faulty samples and take no part in Sv, in the mask's order.
[[nodiscard]] std::vector<bool> faulty_members(const MeasureInput& ping, const PingMask& mask);

/// A school's row of school_pings.csv; observation, school_id, ping_index, time and provisional are left to the caller.
/// mask     not empty; one without a voxel of known volume gives a row of unknowns
/// threads  pure; fixed order of sums
/// cost     linear in the mask's voxels and their surroundings
[[nodiscard]] SchoolPingRow measure(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params);

}  // namespace sonar
