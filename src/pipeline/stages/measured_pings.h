// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "pipeline/survey/survey.h"
#include "school/measure/measure.h"
#include "school/measure/school_errors.h"

namespace sonar {

/// A school in one ping, and which members of its mask are faulty.
struct MeasuredMask {
  MeasuredSchool school;
  std::vector<bool> fault;
  Repeats repeats = {};  ///< the figures under other fading and thresholds
};

/// What was measured of an observation's pings, kept from one measuring to the next: a ping whose masks and numbers are the
/// same is not measured again.
/// threads  one measuring at a time
struct MeasuredPings {
  /// By ping_index: everything that its rows depend on, and one entry for each of its schools.
  std::map<std::int64_t, std::pair<Hash128, std::vector<MeasuredMask>>> pings;
  bool changed = false;  ///< since they were read from a file, or kept in one
};

// A survey that is opened again is not measured again: what was measured last is kept beside its journal.

/// Where an observation's is kept: one file each, written over when it is stale. Empty without a folder.
/// cache  whose folder lies beside the journal, or the user's
[[nodiscard]] std::filesystem::path measured_file(const IndexCache& cache, const SurveyFiles& survey,
                                                  const ObservationFiles& observation);
/// Nothing where there is no such file, it was made of other pings or in another way, or it is damaged.
/// key  observation_key() of pings and recipe, without a journal
[[nodiscard]] MeasuredPings kept_measured(const std::filesystem::path& file, const std::string& key);
/// The bytes that such a file seals, and back; nothing where they are damaged.
[[nodiscard]] std::vector<std::byte> measured_bytes(const MeasuredPings& measured);
[[nodiscard]] MeasuredPings measured_from(std::span<const std::byte> bytes);
/// What cannot be kept is measured again.
void keep_measured(const std::filesystem::path& file, const std::string& key, MeasuredPings& measured);

}  // namespace sonar
