// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/product.h"
#include "pipeline/measure_schools.h"
#include "pipeline/merge_params.h"

// A school is one school: what detection finds of fish that a human has selected is no second one. Detection knows nothing of
// humans; its track, as it was found, tells which parts are one school, whatever came first.
namespace sonar {

/// Masks of a detected school before humans took any; those that it has where none was taken.
[[nodiscard]] std::span<const SchoolMasks::InPing> as_found(const SchoolMasks& school);

/// Whether two schools share so much of the smaller one, over the pings in which both are, that they are the same fish.
/// share  DetectParams::human_share
[[nodiscard]] bool same_fish(std::span<const SchoolMasks::InPing> a, std::span<const SchoolMasks::InPing> b,
                             double share);

/// Which schools are further parts of others: the rest of a detected one that humans selected parts of, and such parts where
/// the detected one joins them; parts that stand side by side in a ping stay two schools. Every part names the one that
/// begins first among humans' parts, and no school names itself over others.
/// out  [school] index of the school that it continues; -1 = none
[[nodiscard]] std::vector<int> continued(std::span<const SchoolMasks* const> schools, double share);

/// Which ends of its track a propagation by hand left only because it was asked no farther: one of kEndNames.
[[nodiscard]] std::string ended_at_reach(const SchoolMasks& school);

/// Fills in decided.continues and decided.ended_at_reach of numbered schools.
/// observation  its name, which stands in `continues`
void name_parts(std::vector<SchoolMasks>& schools, const std::string& observation, double share);

/// An end at a propagation's reach is a cut as the clock's: what begins there, or ended there before, and lies where the
/// school would be is joined to it by `continues`. Ends that stay are noted.
void join_at_reach(ObservationProduct& product, const MergeParams& params);

}  // namespace sonar
