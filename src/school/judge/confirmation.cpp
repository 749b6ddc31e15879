// SPDX-License-Identifier: Apache-2.0
#include "school/judge/confirmation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonar {

std::span<const DetectedPing>::iterator ping_of(std::span<const DetectedPing> pings, std::int64_t ping_index) {
  return std::ranges::lower_bound(pings, ping_index, {}, &DetectedPing::ping_index);
}

std::optional<Reason> judge_confirmation(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings,
                                         const TrackParams& params) {
  std::vector<std::int64_t> clear;
  for (const TrackedDetection& seen : tracked) {
    const DetectedPing& ping = *ping_of(pings, seen.ping_index);
    const bool is_clear = std::ranges::any_of(seen.detections, [&](int d) {
      return ping.detections[static_cast<std::size_t>(d)].evidence >= params.evidence;
    });
    if (is_clear) clear.push_back(seen.ping_index);
  }
  std::size_t most = 0;
  for (auto first = clear.begin(); first != clear.end(); ++first) {
    const auto behind = std::lower_bound(first, clear.end(), *first + params.confirm_window);
    most = std::max(most, static_cast<std::size_t>(behind - first));
  }
  if (most >= static_cast<std::size_t>(params.confirm_pings)) return std::nullopt;
  return Reason{"confirmation", static_cast<double>(most), static_cast<double>(params.confirm_pings), "clear sights"};
}

}  // namespace sonar
