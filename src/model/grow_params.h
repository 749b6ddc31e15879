// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"

namespace sonar {

/// Which voxels touch: the 6 that share a face, or all 26 around.
enum class Connectivity { faces, all };

enum class GrowMode { tracked, paper };
inline constexpr std::array<std::string_view, 2> kGrowModeNames{"tracked", "paper"};
inline constexpr std::array<std::string_view, 2> kConnectivityNames{"6", "26"};

struct GrowParams {
  GrowMode mode = GrowMode::tracked;
  Connectivity connectivity = Connectivity::faces;
  double tolerance_db = 10.0;
  double tolerance_opacity = 0.1;
  double margin_db = 3.0;
};

template <class Visitor>
void describe(Visitor& v, GrowParams& p) {
  v.choice("mode", p.mode, kGrowModeNames,
           "How members are compared with the clicked voxel: tracked takes Sv no more than tolerance_db below it, "
           "paper takes opacities within tolerance_opacity of it. Choose paper to work as the 2007 paper by Balabanian "
           "et al. did.");
  v.choice("connectivity", p.connectivity, kConnectivityNames,
           "Which voxels count as neighbours: the 6 across faces, or all 26. Choose 26 for schools that are thin in "
           "some direction.");
  v.field("tolerance_db", p.tolerance_db,
          {.unit = "dB",
           .min = 0.01,
           .max = 60,
           .text = "Members lie at most this much below the Sv of the clicked voxel; lower it when a click selects too "
                   "much, raise it when it selects too little.",
           .tier = Tier::basic});
  v.field("tolerance_opacity", p.tolerance_opacity,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "Mode paper: members differ in opacity from the clicked voxel by at most this; lower it when a "
                   "click selects too much, raise it when it selects too little."});
  v.field("margin_db", p.margin_db,
          {.unit = "dB",
           .min = 0,
           .max = 30,
           .text = "Mode tracked: members lie at least this much above the beam's background noise; raise it where a "
                   "click selects noise, lower it for weak schools, 0 ignores the noise."});
}

}  // namespace sonar
