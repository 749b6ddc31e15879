// SPDX-License-Identifier: Apache-2.0
#include "school/judge/confirmation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sonar {

namespace {

double evidence_of(const TrackedDetection& seen, const DetectedPing& ping) {
  double most = 0.0;
  for (const int d : seen.detections) {
    most = std::max(most, ping.detections[static_cast<std::size_t>(d)].evidence);
  }
  return std::min(most, kMostEvidence);
}

/// Largest sum over neighbouring sightings of what each has above chance. Pings between them have none; those that nobody
/// could look at are not in the list and tell nothing.
double evidence_together(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings) {
  double sum = 0.0;
  double largest = 0.0;
  auto next = ping_of(pings, tracked.front().ping_index);
  for (const TrackedDetection& seen : tracked) {
    const auto at = ping_of(pings, seen.ping_index);
    sum = std::max(0.0, sum - kChanceEvidence * static_cast<double>(at - next));
    sum = std::max(0.0, sum + evidence_of(seen, *at) - kChanceEvidence);
    largest = std::max(largest, sum);
    next = at + 1;
  }
  return largest;
}

/// In so many pings of the list.
std::size_t most_sightings(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings, int window) {
  std::size_t most = 0;
  auto behind = tracked.begin();
  for (auto first = tracked.begin(); first != tracked.end(); ++first) {
    const auto from = ping_of(pings, first->ping_index);
    while (behind != tracked.end() && ping_of(pings, behind->ping_index) - from < window) ++behind;
    most = std::max(most, static_cast<std::size_t>(behind - first));
  }
  return most;
}

}  // namespace

std::optional<Reason> judge_confirmation(const TrackEcho& track, const ConfirmationParams& params) {
  const auto& [tracked, pings] = track;
  const std::size_t sightings = most_sightings(tracked, pings, params.window);
  if (sightings < static_cast<std::size_t>(params.pings)) {
    return Reason{"confirmation", static_cast<double>(sightings), static_cast<double>(params.pings), "pings"};
  }
  const double evidence = evidence_together(tracked, pings);
  // so many of the clearest are always enough
  const double wanted = std::min(params.evidence, params.pings * (kMostEvidence - kChanceEvidence));
  if (evidence >= wanted) return std::nullopt;
  return Reason{"confirmation", evidence, wanted, kAllSightings};
}

}  // namespace sonar
