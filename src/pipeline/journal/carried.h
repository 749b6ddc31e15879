// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "pipeline/commands/state.h"
#include "pipeline/journal/school_numbers.h"

// Choices name schools by a voxel. Where another version finds masks that have moved a little, that voxel may be nobody's: then
// an older product tells which school it was, and whoever has most of that one now is it.
namespace sonar {

/// Index in the state of the school that is now what an older product had at a voxel: it shares most voxels with it and is
/// the same fish. Empty where no older product has a school there, or none is it now.
[[nodiscard]] std::optional<std::size_t> heir_of(const SchoolKey& key, const JournalState& state,
                                                 const CommandContext& context, const EarlierSchools& earlier);

}  // namespace sonar
