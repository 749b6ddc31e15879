// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"

namespace sonar {

/// How a school is followed over a cut made by observation_max_s, or beyond the end of a reach. Depends on products alone.
struct MergeParams {
  double gate_m = 20.0;
  double length_share = 0.25;
  double depth_gate_m = 10.0;
  int edge_pings = 3;
};

template <class Visitor>
void describe(Visitor& v, MergeParams& p) {
  v.field("gate_m", p.gate_m,
          {.unit = "m", .min = 0, .max = 10000, .text = "the predicted place may miss the found one by this ..."});
  v.field("length_share", p.length_share,
          {.unit = "1", .min = 0, .max = 10, .text = "... and this share of the lengths of both"});
  v.field("depth_gate_m", p.depth_gate_m, {.unit = "m", .min = 0, .max = 10000, .text = "the same for the depth"});
  v.field("edge_pings", p.edge_pings,
          {.unit = "pings",
           .min = 0,
           .max = 1000,
           .text = "pings a school may be missing before or after the cut, or the end of a reach"});
}

}  // namespace sonar
