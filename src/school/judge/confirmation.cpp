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

/// What water alone has where a school was expected lies so far below kChanceEvidence: the largest of some blocks.
const double kNothingThere = std::getenv("NT") ? atof(std::getenv("NT")) : 1.5;

/// Largest sum over neighbouring pings of what each has above chance. Those that nobody could look at are not in the list
/// and tell nothing.
double evidence_together(std::span<const double> passage) {
  double sum = 0.0;
  double largest = 0.0;
  for (const double evidence : passage) {
    const double above = evidence > 0.0 ? std::min(evidence, kMostEvidence) - kChanceEvidence : -kNothingThere;
    sum = std::max(0.0, sum + above);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// In so many pings of the list.
std::size_t most_sights(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings, int window) {
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

std::optional<Reason> judge_confirmation(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings,
                                         std::span<const double> passage, const TrackParams& params) {
  const std::size_t sights = most_sights(tracked, pings, params.confirm_window);
  if (sights < static_cast<std::size_t>(params.confirm_pings)) {
    return Reason{"confirmation", static_cast<double>(sights), static_cast<double>(params.confirm_pings), "sights"};
  }
  const double evidence = evidence_together(passage);
  // so many of the clearest are always enough
  const double wanted = std::min(params.evidence, params.confirm_pings * (kMostEvidence - kChanceEvidence));
  if (evidence >= wanted) return std::nullopt;
  return Reason{"confirmation", evidence, wanted, kAllSights};
}

}  // namespace sonar
