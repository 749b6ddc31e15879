// SPDX-License-Identifier: Apache-2.0
#include "model/current.h"

#include <algorithm>
#include <cmath>

namespace sonar {

std::optional<CurrentAt> current_in(const CurrentProfile& profile, double depth_m, double max_gap_m) {
  const std::vector<CurrentAt>& bins = profile.bins;
  if (bins.empty()) return std::nullopt;
  const auto below =
      std::find_if(bins.begin(), bins.end(), [&](const CurrentAt& bin) { return bin.depth_m >= depth_m; });
  const CurrentAt& lower = below == bins.end() ? bins.back() : *below;
  const CurrentAt& upper = below == bins.begin() ? bins.front() : *(below - 1);
  const double nearest_m = std::min(std::abs(lower.depth_m - depth_m), std::abs(depth_m - upper.depth_m));
  if (nearest_m > max_gap_m) return std::nullopt;
  if (!(lower.depth_m > upper.depth_m)) return CurrentAt{depth_m, lower.east_mps, lower.north_mps};
  const double share = (depth_m - upper.depth_m) / (lower.depth_m - upper.depth_m);
  return CurrentAt{depth_m, upper.east_mps + share * (lower.east_mps - upper.east_mps),
                   upper.north_mps + share * (lower.north_mps - upper.north_mps)};
}

}  // namespace sonar
