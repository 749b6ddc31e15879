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
          {.unit = "m",
           .min = 0,
           .max = 10000,
           .text = "A school that crosses a cut between observations may lie this far from where it is predicted, "
                   "beside a share of its length; raise it where schools swim irregularly."});
  v.field("length_share", p.length_share,
          {.unit = "1",
           .min = 0,
           .max = 10,
           .text = "A school that crosses a cut between observations may lie farther from where it is predicted by "
                   "this share of its lengths before and after; raise it for large, loose schools."});
  v.field("depth_gate_m", p.depth_gate_m,
          {.unit = "m",
           .min = 0,
           .max = 10000,
           .text = "A school that crosses a cut between observations may differ this much in depth from the "
                   "prediction; raise it where schools dive."});
  v.field("edge_pings", p.edge_pings,
          {.unit = "pings",
           .min = 0,
           .max = 1000,
           .text = "A school may be missing in this many pings before or after a cut between observations, or beyond "
                   "the last ping of a propagation, and still be joined; raise it where schools fade for some pings."});
}

}  // namespace sonar
