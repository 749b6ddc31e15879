// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/result.h"
#include "pipeline/engine.h"
#include "pipeline/journal.h"
#include "pipeline/measure_schools.h"
#include "school/grow.h"
#include "school/propagate_paper.h"

namespace sonar {

/// A voxel by its lasting keys.
struct SeedKey {
  int channel = 0;
  int sample = 0;
};

/// The command `propagate`: clicks on one ping, grown, joined and carried through time both ways. Its journal line holds
/// everything it used, so that the recipe's later defaults do not change it.
struct PropagateCommand {
  GrowMode mode = GrowMode::tracked;  ///< how it is carried through time; grow.mode is how the clicks grew
  GrowParams grow;
  std::vector<SeedKey> seeds;
  TransferFunction growth_curve;
  PaperPropagationParams paper;
  TrackedPropagationParams tracked;
  std::int64_t reach = -1;  ///< pings to each side; -1 = as far as the observation goes
};

[[nodiscard]] nlohmann::json to_json(const PropagateCommand& command);
/// errors  format, bad_parameter: naming the member
[[nodiscard]] Result<PropagateCommand> propagate_from_json(const nlohmann::json& args);

/// A school that a human selected, and why its propagation ended on either side.
struct ManualSchool {
  SchoolMasks school;
  std::string note_backward;
  std::string note_forward;
};

/// Carries out one command on the ping of that index.
/// taken   masks of schools that humans selected before, [school]: their voxels stay theirs
/// errors  bad_parameter: the seed, in one line; those of the pings
[[nodiscard]] Result<ManualSchool> propagate(Engine& engine, std::int64_t ping_index, const PropagateCommand& command,
                                             std::span<const SchoolMasks> taken, PingReach limits);

/// Carries out all lines that concern the engine's observation, in order. A line whose ping is not in it is passed over;
/// one that cannot be applied is a diagnostic decision_lost.
[[nodiscard]] std::vector<SchoolMasks> replay(Engine& engine, std::span<const JournalLine> lines, PingReach limits,
                                              Diagnostics& diagnostics);

/// All voxels of some schools in one ping.
[[nodiscard]] PingMask voxels_in_ping(std::span<const SchoolMasks> schools, std::int64_t ping_index);

/// Index of the ping with this datagram time; empty where there is none.
[[nodiscard]] std::optional<std::int64_t> ping_at(const SurveyFiles& survey, const ObservationFiles& observation,
                                                  TimeNs time);

}  // namespace sonar
