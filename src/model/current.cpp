// SPDX-License-Identifier: Apache-2.0
#include "model/current.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

double longest_arrow_mps(std::vector<double> speeds_mps) {
  if (speeds_mps.empty()) return 0.0;
  constexpr double kAboveMost = 1.5;
  const double fastest = *std::max_element(speeds_mps.begin(), speeds_mps.end());
  // Nine tenths, up to the next whole one.
  const std::size_t rank = (9 * speeds_mps.size() + 9) / 10;
  const auto most = speeds_mps.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(speeds_mps.begin(), most, speeds_mps.end());
  const double limit = kAboveMost * *most;
  return limit > 0.0 ? std::min(fastest, limit) : fastest;
}

}  // namespace sonar
