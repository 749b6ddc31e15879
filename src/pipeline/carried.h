// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "pipeline/commands/state.h"
#include "pipeline/school_numbers.h"

// Choices name schools by a voxel. Where another version finds masks that have moved a little, that voxel may be nobody's: then
// an older product tells which school it was, and whoever has most of that one now is it.
namespace sonar {

/// The school that is now what older products had at a voxel: it shares most with it and is the same fish (same_fish()).
/// Empty where no older product has a school there, or none is it now.
[[nodiscard]] std::optional<std::size_t> heir_of(const SchoolKey& key, const JournalState& state,
                                                 const CommandGround& ground, const EarlierSchools& earlier);

/// What a product says of such a choice, so that the product made after it, of moved masks too, knows it again.
/// said  "choice 3 (decide): "
/// now   a voxel that names the heir; ping_index: of its ping
[[nodiscard]] std::string carried_text(const std::string& said, const SchoolKey& key, const SchoolKey& now,
                                       std::int64_t ping_index);

/// A voxel of one ping by a product's own index.
struct PlaceInProduct {
  std::int64_t ping_index = 0;
  int channel = 0;
  int sample = 0;
};
struct CarriedNote {
  int channel = 0;
  int sample = 0;
  PlaceInProduct now;
};
/// Reads carried_text(); empty where it is none.
[[nodiscard]] std::optional<CarriedNote> carried_note(std::string_view text);

}  // namespace sonar
