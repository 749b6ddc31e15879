// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "pipeline/commands/state.h"
#include "pipeline/stages/measure_schools.h"

// A school is one school: what detection finds of fish that a human has selected is no second one. Detection knows nothing of
// humans; its track, as it was found, tells which masks are one school, whatever came first.
namespace sonar {

/// Of the smaller one: masks that share more are the same fish.
inline constexpr double kSameFishShare = 0.25;

/// Voxels that two schools have in common. Both are sorted by ping.
[[nodiscard]] std::size_t shared_voxels(std::span<const SchoolMasks::InPing> a, std::span<const SchoolMasks::InPing> b);
/// Whether two schools are the same fish, over the pings in which they have voxels in common.
[[nodiscard]] bool same_fish(std::span<const SchoolMasks::InPing> a, std::span<const SchoolMasks::InPing> b);

/// Which schools are further parts of others: the rest of a detected one that humans took voxels of, and all that was made of
/// these voxels. Of what one detected school joins, all is part of the human's that begins first.
/// out  [school] index of the school that it continues; -1 = none
[[nodiscard]] std::vector<int> continued(std::span<const SchoolMasks* const> schools);

/// The ends of a school of a state at which it had its reach, and beyond which no other part of it is known.
/// out  as SchoolRow::ended_at_reach
[[nodiscard]] std::string open_ends(const JournalState& state, const StateSchool& school);

/// Fills in decided.continues of numbered schools.
/// observation  its name, which stands in the column
void name_parts(std::vector<SchoolMasks>& schools, const std::string& observation);

}  // namespace sonar
