// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "base/units.h"
#include "model/mask.h"
#include "model/school.h"
#include "pipeline/score/score_index.h"

namespace sonar {

/// A true school in one ping and what was found there.
struct PingPair {
  std::int64_t ping_index = 0;  ///< of the truth
  const PingMask* truth = nullptr;
  const SchoolPingRow* truth_row = nullptr;
  bool unclipped = false;
  std::size_t found_observation = 0;
  std::int64_t found_ping = -1;      ///< -1 = this ping is not in the result
  std::optional<SchoolKey> partner;  ///< largest overlap
  std::size_t overlap = 0;
};

/// Every school of the truth, ping by ping. Borrows from both.
[[nodiscard]] std::map<SchoolKey, std::vector<PingPair>> pair_pings(const Indexed& found, const Indexed& truth,
                                                                    const ScoreSide& truth_side);

/// The track that is the partner in most pings; among equals the larger overlap, then the lower number.
[[nodiscard]] std::optional<SchoolKey> track_partner(const std::vector<PingPair>& pairs);

/// Sums of one figure over the pings that have it on both sides.
class PairedMeans {
 public:
  void add(double found, double truth) {
    if (!std::isfinite(found) || !std::isfinite(truth)) return;
    found_ += found;
    truth_ += truth;
  }
  [[nodiscard]] double ratio() const { return truth_ > 0.0 ? found_ / truth_ : kUnknown; }
  [[nodiscard]] double error_db() const {
    return truth_ > 0.0 && found_ > 0.0 ? db_from_linear(found_ / truth_) : kUnknown;
  }

 private:
  double found_ = 0.0;
  double truth_ = 0.0;
};

/// Between two centres, m; NaN where one is unknown.
[[nodiscard]] double distance_m(const SchoolPingRow& a, const SchoolPingRow& b);

}  // namespace sonar
