// SPDX-License-Identifier: Apache-2.0
#include "school/judge/side_lobe.h"

#include <algorithm>
#include <vector>

#include "base/median.h"
#include "school/judge/confirmation.h"

namespace sonar {
namespace {

/// Side lobes of an array that is shaded for -25 dB and sends and receives with the errors of real elements lie so far below
/// its main lobe both ways (Kongsberg states -25 dB for each way; elements that fail or drift take half of it away).
constexpr double kSideLobes_db = 25.0;

}  // namespace

std::optional<Reason> judge_side_lobe(std::span<const TrackedDetection> tracked, std::span<const DetectedPing> pings) {
  std::vector<double> louder_db;
  for (const TrackedDetection& seen : tracked) {
    const DetectedPing& ping = *ping_of(pings, seen.ping_index);
    const Detection& echo = ping.detections[static_cast<std::size_t>(seen.detections.front())];
    const int middle = (echo.box.first_sample + echo.box.last_sample) / 2;
    double most_db = 0.0;
    for (const Detection& other : ping.detections) {
      if (middle < other.box.first_sample || middle > other.box.last_sample) continue;
      most_db = std::max(most_db, other.reference_db - echo.reference_db);
    }
    if (most_db >= kSideLobes_db) louder_db.push_back(most_db);
  }
  if (louder_db.empty() || 2 * louder_db.size() < tracked.size()) return std::nullopt;
  return Reason{"side_lobe", middle_of(std::move(louder_db)), kSideLobes_db, "dB louder at its range"};
}

}  // namespace sonar
