// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/describe.h"
#include "base/result.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "school/detect/filtered_ping.h"
#include "school/grow/grow.h"
#include "school/grow/propagate_paper.h"
#include "school/runs.h"

namespace sonar {

struct TrackedPropagationParams {
  double tolerance_db = 10.0;
  double margin_db = 5.0;
  double reference_percentile = 90.0;
  double max_reference_step_db = 3.0;
  double max_growth = 2.0;
  double gate_m = 15.0;
  double gate_speed_mps = 2.0;
  int gate_fans = 1;
  int gate_beams = 2;
  int max_lost_pings = 3;
  double cut_growth = 2.0;
  int tries = 4;
  double tighter = 0.75;
  int seed_samples = 2;
  double acceleration_mps2 = 0.05;
  double initial_speed_mps = 1.0;
  double position_share = 0.08;
  double min_position_m = 2.0;
  double censored_m = 200.0;
  Connectivity connectivity = Connectivity::faces;
};

template <class Visitor>
void describe(Visitor& v, TrackedPropagationParams& p) {
  v.field("tolerance_db", p.tolerance_db,
          {.unit = "dB", .min = 0.1, .max = 60, .text = "members lie no deeper below the school's reference level"});
  v.field("margin_db", p.margin_db,
          {.unit = "dB",
           .min = 0,
           .max = 30,
           .text = "and stand so far above the background: a school that has left is not sought in it; 0 = anywhere"});
  v.field("reference_percentile", p.reference_percentile,
          {.unit = "%", .min = 1, .max = 100, .text = "share of the school's voxels below its reference level"});
  v.field("max_reference_step_db", p.max_reference_step_db,
          {.unit = "dB", .min = 0, .max = 60, .text = "largest change of the reference from ping to ping"});
  v.field("max_growth", p.max_growth,
          {.unit = "1", .min = 1, .max = 100, .text = "largest ratio of volumes from ping to ping; more is a leak"});
  v.field("gate_m", p.gate_m,
          {.unit = "m", .min = 0, .max = 1000, .text = "growth stays this near to the predicted school"});
  v.field("gate_speed_mps", p.gate_speed_mps,
          {.unit = "m s-1", .min = 0, .max = 20, .text = "the gate widens by this for each second since last seen"});
  v.field("gate_fans", p.gate_fans, {.unit = "fans", .min = 0, .max = 100, .text = "the gate's least reach"});
  v.field("gate_beams", p.gate_beams, {.unit = "beams", .min = 0, .max = 100, .text = "the gate's least reach"});
  v.field("max_lost_pings", p.max_lost_pings,
          {.unit = "pings", .min = 0, .max = 100, .text = "a school lost for so many pings may be found again"});
  v.field(
      "cut_growth", p.cut_growth,
      {.unit = "1", .min = 1, .max = 100, .text = "a school that a border cuts may grow so much more: it comes in"});
  v.field("tries", p.tries,
          {.unit = "1", .min = 1, .max = 100, .text = "growths with ever tighter tolerance before a leak is given up"});
  v.field("tighter", p.tighter,
          {.unit = "1", .min = 0.01, .max = 1, .text = "factor on the tolerance from one try to the next"});
  v.field("seed_samples", p.seed_samples,
          {.unit = "samples", .min = 1, .max = 1000, .text = "every so-manyth sample of the moved mask is a seed"});
  v.field("acceleration_mps2", p.acceleration_mps2,
          {.unit = "m s-2", .min = 0.0001, .max = 10, .text = "how strongly schools change their velocity"});
  v.field("initial_speed_mps", p.initial_speed_mps,
          {.unit = "m s-1", .min = 0, .max = 20, .text = "spread of the clicked school's velocity, per axis"});
  v.field("position_share", p.position_share,
          {.unit = "1", .min = 0.001, .max = 2, .text = "uncertainty of a centre as a share of the school's extent"});
  v.field("min_position_m", p.min_position_m, {.unit = "m", .min = 0.01, .max = 100, .text = "its least value"});
  v.field("censored_m", p.censored_m,
          {.unit = "m", .min = 1, .max = 100000, .text = "uncertainty of a coordinate that a border cuts off"});
  v.choice("connectivity", p.connectivity, kConnectivityNames, "neighbours of a voxel: 6 faces or all 26");
}

/// Carries a school through time without the paper's limits: the whole previous mask, moved over ground by the ship's
/// and the school's movement, seeds the next ping; one-sided threshold below a reference that follows the school; a
/// school partly outside stays in the track, coordinates cut by the sector's borders do not move its velocity.
/// Members stand above the background: the water's too if the selection does, for a human may have pointed at a layer.
/// sector     of the observation (one grid and range axis for all pings)
/// selection  the mask in ping `clicked`, not empty; kept as it is
/// errors     as propagate_paper
[[nodiscard]] Result<Propagation> propagate_tracked(const PingProvider& pings, const Sector& sector,
                                                    std::int64_t clicked, const PingMask& selection, PingReach reach,
                                                    const TrackedPropagationParams& params,
                                                    const PropagationObserver& on_step = {});

}  // namespace sonar
