// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/result.h"
#include "pipeline/commands/command.h"
#include "pipeline/journal/journal.h"
#include "pipeline/journal/manual.h"
#include "pipeline/stages/measure_schools.h"

namespace sonar {

/// How a school came to be that only clicks of one ping and propagations from there have made: it can be grown again.
struct GrownFrom {
  std::int64_t ping_index = 0;
  GrowCommand grow;
  std::vector<PropagateCommand> followed;  ///< in order, each from that ping
};

/// A school as the journal has left it.
struct StateSchool {
  /// 1, 2, ... in the order in which schools came to be; for people. Below 0: found, and not asked for yet.
  std::int64_t number = 0;
  std::int64_t made_by = 0;  ///< the journal line that made it; 0 = detected
  bool by_hand = false;      ///< a human made or changed its mask
  SchoolMasks masks;
  std::shared_ptr<const GrownFrom> grown;  ///< null = it was made or changed in another way
};

/// "school 3", or "school 3 (north wall)" where it has a name.
[[nodiscard]] std::string school_title(const StateSchool& school);

/// A human made, changed or accepted its mask: growths and propagations of other schools leave its voxels alone.
[[nodiscard]] bool keeps_its_voxels(const StateSchool& school);

/// What one observation's journal says up to some line. A value: a later state shares what did not change.
struct JournalState {
  std::vector<std::shared_ptr<const StateSchool>> schools;  ///< rising number
  std::int64_t next_number = 1;
  std::int64_t unnumbered = 0;                           ///< how many were found that have no numbers yet
  std::vector<EventCommand> events;                      ///< in time order
  std::vector<BadPingsCommand> bad_pings;                ///< as they were said, less what is good again
  std::shared_ptr<const CalibrationParams> calibration;  ///< that Sv and measures follow; null = the recipe's
  Diagnostics notes;  ///< decisions that could not be applied, why propagations ended
};

/// The state before the first line: what was detected.
[[nodiscard]] JournalState state_of_detected(std::vector<SchoolMasks> schools);
/// The same where a line `detect` asks for them: from there on they have numbers, above those of the schools that were
/// there before, so that finding schools renames none.
[[nodiscard]] JournalState state_before_detection(std::vector<SchoolMasks> schools);

/// Whether an act says something about the pings of an observation; one that does not leaves every state of it as it is.
[[nodiscard]] bool holds_here(const JournalAct& act, const CommandContext& context);

/// The state after one more act. An act on other pings changes nothing.
/// errors   bad_parameter: what it needs is not there, in one line; those of the pings. The state stands.
/// threads  pure, as far as context.ping is
[[nodiscard]] Result<JournalState> apply(const JournalAct& act, const JournalState& state,
                                         const CommandContext& context);

/// An act as it was carried out, and the state after it.
struct Applied {
  JournalAct act;  ///< the journal's: a propagation that the observer stopped names the pings that it reached
  JournalState state;
};

/// apply() for acts that context.on_step watches and may stop: apply(act) of what comes back, without an observer, gives
/// this state bit for bit.
[[nodiscard]] Result<Applied> apply_watched(const JournalAct& act, const JournalState& state,
                                            const CommandContext& context);

/// The state after all lines (undo and redo already worked in, see effective_lines()). A line that cannot be applied is a
/// diagnostic decision_lost and changes nothing else.
[[nodiscard]] JournalState fold(std::span<const ReadLine> lines, JournalState state, const CommandContext& context);
[[nodiscard]] JournalState fold(std::span<const JournalLine> lines, JournalState state, const CommandContext& context);
/// What the lines say that needs no mask: marks, bad pings, the calibration.
/// times  [ping_index], datagram times, rising
[[nodiscard]] JournalState fold_without_masks(std::span<const ReadLine> lines, std::span<const TimeNs> times);

/// Index in state.schools of the school that has a voxel; empty where nobody has it.
[[nodiscard]] std::optional<std::size_t> school_at(const JournalState& state, const CommandContext& context,
                                                   const SchoolKey& key);
/// A voxel that names a school: of its middle ping one of the surest.
[[nodiscard]] SchoolKey key_of(const SchoolMasks& school, const CommandContext& context);

/// Index of the ping with this datagram time; empty where there is none within the context's limits.
[[nodiscard]] std::optional<std::int64_t> ping_at(const CommandContext& context, TimeNs time);
[[nodiscard]] bool is_bad(const JournalState& state, TimeNs ping_time);

/// The recipe that Sv and measures follow: this one, under the calibration that a human has chosen.
[[nodiscard]] Recipe measuring_recipe(const Recipe& recipe, const JournalState& state);

[[nodiscard]] std::vector<SchoolMasks> masks_of(const JournalState& state);
/// The same without bad pings: what is measured.
[[nodiscard]] std::vector<SchoolMasks> measured_masks_of(const JournalState& state, std::span<const TimeNs> times);

/// A school's mask in a ping; null where it has none.
[[nodiscard]] const SchoolMasks::InPing* in_ping(const SchoolMasks& school, std::int64_t ping_index);

}  // namespace sonar
