// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "pipeline/commands/state.h"
#include "school/track/track.h"

// Two schools that may be one: a human is asked, nothing is merged by itself.
namespace sonar {

/// Of the smaller one: so much of its mask in a ping lies against the other school, or in it.
inline constexpr double kTouchingShare = 0.1;

struct MergeProposal {
  std::int64_t first = 0;  ///< StateSchool::number of the one that begins first; it stays
  std::int64_t other = 0;
  /// In the same ping where they touch; else the end of the first and the beginning of the other.
  std::int64_t first_ping = 0;
  std::int64_t other_ping = 0;
  [[nodiscard]] bool touching() const { return first_ping == other_ping; }
  friend bool operator==(const MergeProposal&, const MergeProposal&) = default;
};

struct ProposalLimits {
  TrackParams track;  ///< how long a school may be lost, and where it may be found again
  std::function<Placement(std::int64_t ping_index)> placement;
  std::function<bool()> stopped = {};  ///< nobody waits any more: what was found so far comes back
};

/// Pairs of schools whose masks touch in a ping, and pairs of which one begins where the tracker would look for the other: at
/// most track.max_lost_pings and max_lost_s after its end, within gate_sigmas of where its last pings lead. Rejected schools
/// are in no pair; neither are two that are known as one (continued()).
/// of       numbers of schools; each pair has one of them. Empty = all
/// out      by first, then other
/// threads  pure, as far as the placement is
[[nodiscard]] std::vector<MergeProposal> merge_proposals(const JournalState& state, const CommandContext& context,
                                                         const ProposalLimits& limits,
                                                         const std::set<std::int64_t>& of = {});

/// Whether it still says what it said of this state: neither mask has changed where they meet.
/// told  the state that it was made for
[[nodiscard]] bool still_holds(const MergeProposal& proposal, const JournalState& told, const JournalState& now);

}  // namespace sonar
