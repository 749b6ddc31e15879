// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "pipeline/journal/journal.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/measure_schools.h"
#include "school/grow/grow.h"
#include "school/grow/propagate_paper.h"

namespace sonar {

/// A voxel by its lasting keys.
struct SeedKey {
  int channel = 0;
  int sample = 0;
};

/// A school by one of its voxels: display names may change, this does not.
struct SchoolKey {
  TimeNs ping_time = 0;  ///< of the datagram
  int channel = 0;
  int sample = 0;
  friend bool operator==(const SchoolKey&, const SchoolKey&) = default;
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
  /// Pings to one side, where it differs: what a stopped propagation had reached.
  std::optional<std::int64_t> reach_backward;
  std::optional<std::int64_t> reach_forward;
  /// Instead of seeds: a school is carried on from the mask that it has in this ping, over what it had on either side.
  std::optional<SchoolKey> school;
};

/// A selection and propagation as a recipe sets it: no seeds, as far as it goes.
/// mode  empty = the recipe's
[[nodiscard]] PropagateCommand recipe_propagation(const Recipe& recipe, std::optional<GrowMode> mode);
/// What is selected with all 26 neighbours is followed with them; and whether all parameters are in their ranges.
/// errors  bad_parameter
[[nodiscard]] Result<PropagateCommand> completed(PropagateCommand command);

/// The command that ends so many pings before and after its own: what a stopped propagation is in the journal.
[[nodiscard]] PropagateCommand as_far_as(PropagateCommand command, std::int64_t backward, std::int64_t forward);

/// Whether a propagation was asked to go backwards, or forwards.
[[nodiscard]] bool goes_backward(const PropagateCommand& command);
[[nodiscard]] bool goes_forward(const PropagateCommand& command);

/// A school that a human selected, and why its propagation ended on either side.
struct ManualSchool {
  SchoolMasks school;  ///< with the ends at which it was followed until the command asked no farther
  std::string note_backward;
  std::string note_forward;
  PropagateCommand reached;  ///< the command that gives this without an observer: itself, or as far as it was let go
};

struct EarlierSchools;

/// What commands need of an observation. Views: what they show outlives the commands.
struct CommandContext {
  PingProvider ping;  ///< filtered volumes; FilteredPing::taken is not looked at
  const Sector* sector = nullptr;
  const BeamGrid* grid = nullptr;
  std::vector<TimeNs> times;                ///< [ping_index], datagram times
  PingReach limits;                         ///< pings that may be visited
  int least_pings = 1;                      ///< a detected school of which humans left fewer is gone
  const EarlierSchools* earlier = nullptr;  ///< where schools lay that choices may name; null = nobody knows
  PropagationObserver on_step = {};  ///< sees, and may stop, what apply() carries through time; fold() tells nothing
};
[[nodiscard]] CommandContext context_of(Engine& engine, PingReach limits);

/// Grows from all seeds and joins what they give.
/// errors  bad_parameter: the seed, in one line
[[nodiscard]] Result<PingMask> grow_seeds(const CommandContext& context, const FilteredPing& ping,
                                          std::span<const SeedKey> seeds, const TransferFunction& growth_curve,
                                          const GrowParams& params);

/// Voxels of a ping that are others'.
using TakenVoxels = std::function<PingMask(std::int64_t ping_index)>;

/// Carries a mask of one ping through time; context.on_step may stop it.
/// errors  bad_parameter: an empty mask; those of the pings
[[nodiscard]] Result<ManualSchool> carry(const CommandContext& context, std::int64_t ping_index,
                                         const PingMask& selection, const PropagateCommand& command,
                                         const TakenVoxels& taken);

/// Masks of the schools that the lines make where nothing was detected; see pipeline/commands/state.h.
[[nodiscard]] std::vector<SchoolMasks> replay(Engine& engine, std::span<const JournalLine> lines, PingReach limits,
                                              Diagnostics& diagnostics);

/// Index of the ping with this datagram time; empty where there is none.
[[nodiscard]] std::optional<std::int64_t> ping_at(const SurveyFiles& survey, const ObservationFiles& observation,
                                                  TimeNs time);

}  // namespace sonar
