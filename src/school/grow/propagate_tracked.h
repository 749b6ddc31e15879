// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/describe.h"
#include "base/result.h"
#include "geo/sector.h"
#include "model/filtered_ping.h"
#include "model/mask.h"
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
          {.unit = "dB",
           .min = 0.1,
           .max = 60,
           .text = "Members lie at most this much below the school's reference level; lower it when the school grows "
                   "into its surroundings, raise it for schools with a faint margin."});
  v.field("margin_db", p.margin_db,
          {.unit = "dB",
           .min = 0,
           .max = 30,
           .text = "Members lie at least this much above the background; raise it where a school that has left is "
                   "still followed in noise, lower it for weak schools, 0 ignores the background."});
  v.field("reference_percentile", p.reference_percentile,
          {.unit = "%",
           .min = 1,
           .max = 100,
           .text = "Percentile of the school's Sv that serves as its reference level; lower it when a few bright "
                   "voxels set the level too high."});
  v.field("max_reference_step_db", p.max_reference_step_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "Largest change of the reference level from one ping to the next; raise it for schools that change "
                   "their aspect quickly."});
  v.field("max_growth", p.max_growth,
          {.unit = "1",
           .min = 1,
           .max = 100,
           .text = "Largest ratio of a school's volumes from one ping to the next; more growth counts as a leak and is "
                   "tried again with a smaller tolerance. Raise it for schools that spread out quickly."});
  v.field("gate_m", p.gate_m,
          {.unit = "m",
           .min = 0,
           .max = 1000,
           .text = "Growth stays within this distance of the school's predicted place; raise it for schools that swim "
                   "irregularly, lower it where other echoes lie close."});
  v.field("gate_speed_mps", p.gate_speed_mps,
          {.unit = "m s-1",
           .min = 0,
           .max = 20,
           .text = "By how much the distance gate_m widens for each second since the school was last seen; raise it "
                   "for fast fish."});
  v.field("gate_fans", p.gate_fans,
          {.unit = "fans",
           .min = 0,
           .max = 100,
           .text = "Growth may reach at least this many fans beyond the school's predicted place, even where gate_m "
                   "allows fewer; raise it if distant schools that change depth are lost."});
  v.field("gate_beams", p.gate_beams,
          {.unit = "beams",
           .min = 0,
           .max = 100,
           .text = "Growth may reach at least this many beams beyond the school's predicted place, even where gate_m "
                   "allows fewer; raise it if distant schools are lost sideways."});
  v.field("max_lost_pings", p.max_lost_pings,
          {.unit = "pings",
           .min = 0,
           .max = 100,
           .text = "A school may go unseen in up to this many pings and still be found again, bad pings not counted; "
                   "raise it for schools that fade for several pings."});
  v.field("cut_growth", p.cut_growth,
          {.unit = "1",
           .min = 1,
           .max = 100,
           .text = "Factor on max_growth for a school that the sector's border cuts, since more of it may come into "
                   "view; raise it if large schools are lost as they enter the sector."});
  v.field("tries", p.tries,
          {.unit = "1",
           .min = 1,
           .max = 100,
           .text = "Most attempts to grow a school in one ping, each with a smaller tolerance, before a school that "
                   "leaks counts as lost; raise it where schools lie close to other echoes."});
  v.field("tighter", p.tighter,
          {.unit = "1",
           .min = 0.01,
           .max = 1,
           .text = "Factor on the tolerance from one attempt to grow a school to the next; lower it to stop leaks in "
                   "fewer attempts, raise it to keep more of the school's margin."});
  v.field("seed_samples", p.seed_samples,
          {.unit = "samples",
           .min = 1,
           .max = 1000,
           .text = "Spacing, along each beam, of the samples in the predicted mask from which growth starts; lower it "
                   "for very small or patchy schools, raise it to save time."});
  v.field("acceleration_mps2", p.acceleration_mps2,
          {.unit = "m s-2",
           .min = 0.0001,
           .max = 10,
           .text = "Standard deviation of a school's acceleration; raise it for schools that turn sharply."});
  v.field("initial_speed_mps", p.initial_speed_mps,
          {.unit = "m s-1",
           .min = 0,
           .max = 20,
           .text = "Standard deviation of the selected school's speed along each axis before it is measured; raise it "
                   "for fast fish."});
  v.field(
      "position_share", p.position_share,
      {.unit = "1",
       .min = 0.001,
       .max = 2,
       .text =
           "Uncertainty of a school's centre as a share of its extent; raise it for schools that change their shape."});
  v.field("min_position_m", p.min_position_m,
          {.unit = "m",
           .min = 0.01,
           .max = 100,
           .text = "Least standard deviation of a school's measured centre along each axis; raise it where the ship's "
                   "position or heading is noisy, lower it for small schools whose movement is well seen."});
  v.field("censored_m", p.censored_m,
          {.unit = "m",
           .min = 1,
           .max = 100000,
           .text = "Standard deviation of a school's centre across a border of the sector that cuts the school; raise "
                   "it where schools are larger than this, so that a cut does not pass for movement."});
  v.choice("connectivity", p.connectivity, kConnectivityNames,
           "Which voxels count as neighbours: the 6 across faces, or all 26. Choose 26 for schools that are thin in "
           "some direction.");
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
