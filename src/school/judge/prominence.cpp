// SPDX-License-Identifier: Apache-2.0
#include "school/judge/prominence.h"

namespace sonar {

std::optional<Reason> judge_prominence(const PingEcho& /*echo*/, const Detection& detection) {
  const double above_db = detection.reference_db - detection.threshold_db;
  if (above_db >= kLeastProminence_db) return std::nullopt;
  return Reason{"prominence", above_db, kLeastProminence_db, "dB"};
}

}  // namespace sonar
