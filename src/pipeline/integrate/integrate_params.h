// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"
#include "base/result.h"
#include "school/integrate/cells.h"

namespace sonar {

/// How water is cut for echo integration.
struct IntegrateParams {
  double edsu_nmi = 1.0;
  double range_bin_m = 50.0;
  double depth_channel_m = 10.0;
  double max_range_m = 0.0;
  double depth_min_m = 0.0;
  double depth_max_m = 0.0;
  double layer_top_m = 0.0;
  double layer_bottom_m = 0.0;
};

template <class Visitor>
void describe(Visitor& v, IntegrateParams& p) {
  v.field(
      "edsu_nmi", p.edsu_nmi,
      {.unit = "nmi",
       .min = 0.001,
       .max = 1000,
       .text = "Length of an elementary distance sampling unit, nmi along the transect; lower it where transects are "
               "short."});
  v.field("range_bin_m", p.range_bin_m,
          {.unit = "m",
           .min = 1,
           .max = 10000,
           .text = "Length of a range bin, m from the transducer; lower it to see how figures fall off with range."});
  v.field("depth_channel_m", p.depth_channel_m,
          {.unit = "m",
           .min = 1,
           .max = 10000,
           .text = "Height of a depth channel, m; raise it where the beam is much higher (see beam_filling)."});
  v.field("max_range_m", p.max_range_m,
          {.unit = "m",
           .min = 0,
           .max = 100000,
           .text = "Samples from this range on are left out, m; 0 takes all. Lower it where sv_limit_db is too high."});
  v.field(
      "depth_min_m", p.depth_min_m,
      {.unit = "m",
       .min = 0,
       .max = 10000,
       .text = "Depth at which the first channel begins, m; raise it to leave out bubbles and what side lobes hear of "
               "the surface."});
  v.field(
      "depth_max_m", p.depth_max_m,
      {.unit = "m",
       .min = 0,
       .max = 10000,
       .text = "Channels that reach below this depth are left out, m; 0 takes all. Set it above the shallowest seabed "
               "where the seabed is not found."});
  v.field("layer_top_m", p.layer_top_m,
          {.unit = "m",
           .min = 0,
           .max = 10000,
           .text = "Depth at which the layer of fish begins, m, where an echosounder or a trawl told it; goes with the "
                   "layer's bottom."});
  v.field("layer_bottom_m", p.layer_bottom_m,
          {.unit = "m",
           .min = 0,
           .max = 10000,
           .text = "Depth at which that layer ends, m: it is the only depth channel then. 0 = channels of one height, "
                   "from depth_min_m down."});
}

/// errors  bad_parameter: out of range, a layer that ends above its top, or no channel between the depths
[[nodiscard]] Result<CellLayout> cell_layout(const IntegrateParams& params);

}  // namespace sonar
