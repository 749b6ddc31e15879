// SPDX-License-Identifier: Apache-2.0
#include "school/judge/confirmation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sonar {

std::span<const DetectedPing>::iterator ping_of(std::span<const DetectedPing> pings, std::int64_t ping_index) {
  return std::ranges::lower_bound(pings, ping_index, {}, &DetectedPing::ping_index);
}

namespace {

double evidence_of(const TrackedDetection& seen, const DetectedPing& ping) {
  double most = 0.0;
  for (const int d : seen.detections) {
    most = std::max(most, ping.detections[static_cast<std::size_t>(d)].evidence);
  }
  return std::min(most, kMostEvidence);
}

/// Largest sum over neighbouring sights of what each has above chance; pings between them have none.
double evidence_together(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings) {
  double sum = 0.0;
  double largest = 0.0;
  std::int64_t next = tracked.front().ping_index;
  for (const TrackedDetection& seen : tracked) {
    sum = std::max(0.0, sum - kChanceEvidence * static_cast<double>(seen.ping_index - next));
    sum = std::max(0.0, sum + evidence_of(seen, *ping_of(pings, seen.ping_index)) - kChanceEvidence);
    largest = std::max(largest, sum);
    next = seen.ping_index + 1;
  }
  return largest;
}

std::size_t most_sights(std::span<const TrackedDetection> tracked, int window) {
  std::size_t most = 0;
  for (auto first = tracked.begin(); first != tracked.end(); ++first) {
    const auto behind = std::lower_bound(
        first, tracked.end(), first->ping_index + window,
        [](const TrackedDetection& seen, std::int64_t ping_index) { return seen.ping_index < ping_index; });
    most = std::max(most, static_cast<std::size_t>(behind - first));
  }
  return most;
}

}  // namespace

std::optional<Reason> judge_confirmation(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings,
                                         const TrackParams& params) {
  const std::size_t sights = most_sights(tracked, params.confirm_window);
  if (sights < static_cast<std::size_t>(params.confirm_pings)) {
    return Reason{"confirmation", static_cast<double>(sights), static_cast<double>(params.confirm_pings), "sights"};
  }
  const double evidence = evidence_together(tracked, pings);
  if (evidence >= params.evidence) return std::nullopt;
  return Reason{"confirmation", evidence, params.evidence, "evidence of all sights"};
}

}  // namespace sonar
