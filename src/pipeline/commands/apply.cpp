// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <variant>

#include "pipeline/commands/edit.h"
#include "pipeline/commands/state.h"

namespace sonar {
namespace {

std::string place_of(const SchoolKey& key) {
  return fmt::format("{}, channel {}, sample {}", iso_time(key.ping_time), key.channel, key.sample);
}

/// What a propagation replaces of a school that is carried on: the sides that it was asked for.
std::vector<SchoolMasks::InPing> kept_pings(const SchoolMasks& school, std::int64_t from,
                                            const PropagateCommand& command, PingReach limits) {
  const bool backward = goes_backward(command);
  const bool forward = goes_forward(command);
  std::vector<SchoolMasks::InPing> kept;
  for (const SchoolMasks::InPing& there : school.pings) {
    const bool within = there.ping_index >= limits.first && there.ping_index <= limits.last;
    const bool replaced = there.ping_index == from || (there.ping_index < from ? backward : forward);
    if (!within || !replaced) kept.push_back(there);
  }
  return kept;
}

void note_ends(Edit& edit, const ManualSchool& made) {
  for (const auto& [side, note] : {std::pair("backwards", made.note_backward), {"forwards", made.note_forward}}) {
    if (!note.empty()) edit.note(DiagnosticCode::propagation_ended, fmt::format("{}: {}", side, note));
  }
}

/// What is carried on again replaces what was carried to the same sides before.
std::shared_ptr<const GrownFrom> followed_by(const GrownFrom& before, const PropagateCommand& command) {
  auto grown = std::make_shared<GrownFrom>(before);
  std::erase_if(grown->followed, [&](const PropagateCommand& one) {
    return (goes_backward(command) || !goes_backward(one)) && (goes_forward(command) || !goes_forward(one));
  });
  grown->followed.push_back(command);
  return grown;
}

Result<PingMask> selection_of(const Edit& edit, const PropagateCommand& command, std::optional<std::size_t> school) {
  if (school) {
    if (in_ping(edit.masks(*school), edit.ping()) == nullptr) {
      return fail(ErrorCode::bad_parameter, "the school is not in this ping");
    }
    return edit.mask(*school, edit.ping());
  }
  auto ping = edit.context().ping(edit.ping());
  if (!ping) return pass_on(ping);
  ping->taken = edit.taken(edit.ping(), {});
  return grow_seeds(edit.context(), *ping, command.seeds, command.growth_curve, command.grow);
}

Result<void> apply_to_ping(Edit& edit, const Command& command) {
  return std::visit(
      [&](const auto& one) -> Result<void> {
        using C = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<C, EventCommand> || std::is_same_v<C, BadPingsCommand> ||
                      std::is_same_v<C, RemoveEventCommand> || std::is_same_v<C, GoodPingsCommand> ||
                      std::is_same_v<C, CalibrateCommand>) {
          return {};
        } else {
          return carry_out(edit, one);
        }
      },
      command);
}

/// Acts that say something about times, not about the ping that they were done on.
bool about_times(const Command& command) {
  return std::holds_alternative<EventCommand>(command) || std::holds_alternative<BadPingsCommand>(command) ||
         std::holds_alternative<RemoveEventCommand>(command) || std::holds_alternative<GoodPingsCommand>(command) ||
         std::holds_alternative<CalibrateCommand>(command) || std::holds_alternative<DecideCommand>(command);
}

bool overlaps(const CommandContext& context, TimeNs first, TimeNs last) {
  return !context.times.empty() && first <= context.times.back() && last >= context.times.front();
}

/// What is no school's: marks and bad pings, where the observation has such times, and the calibration.
Result<void> say_of_times(Edit& edit, const Command& command) {
  const CommandContext& context = edit.context();
  if (const auto* event = std::get_if<EventCommand>(&command)) {
    if (overlaps(context, event->time, event->time)) edit.add_event(*event);
  } else if (const auto* removed = std::get_if<RemoveEventCommand>(&command)) {
    if (overlaps(context, removed->event.time, removed->event.time)) return edit.remove_event(removed->event);
  } else if (const auto* bad = std::get_if<BadPingsCommand>(&command)) {
    if (overlaps(context, bad->first, bad->last)) edit.take_bad(command);
  } else if (const auto* good = std::get_if<GoodPingsCommand>(&command)) {
    if (overlaps(context, good->first, good->last)) edit.take_bad(command);
  } else if (const auto* calibrate = std::get_if<CalibrateCommand>(&command)) {
    edit.calibrate(calibrate->calibration);
  }
  return {};
}

}  // namespace

Result<void> carry_out(Edit& edit, const PropagateCommand& command) {
  std::optional<std::size_t> school;
  if (command.school) {
    const auto found = edit.find(*command.school);
    if (!found) return pass_on(found);
    school = *found;
  }
  const auto selection = selection_of(edit, command, school);
  if (!selection) return pass_on(selection);
  const TakenVoxels taken = [&](std::int64_t ping_index) { return edit.taken(ping_index, school); };
  auto made = carry(edit.context(), edit.ping(), *selection, command, taken);
  if (!made) return pass_on(made);
  note_ends(edit, *made);
  edit.carried_out_as(made->reached);
  const std::vector<SchoolMasks::InPing> carried = made->school.pings;
  if (school) {
    const auto before = edit.state().schools[*school]->grown;
    edit.touch(*school);
    if (before && before->ping_index == edit.ping()) edit.set_grown(*school, followed_by(*before, made->reached));
    edit.set_pings(*school, kept_pings(edit.masks(*school), edit.ping(), made->reached, edit.context().limits));
    for (const auto& there : carried) edit.set_mask(*school, there.ping_index, there.mask, there.threshold_db);
    // A side that was not followed ends as it did before.
    ReachEnds ends = edit.masks(*school).reach;
    if (goes_backward(made->reached)) ends.first = made->school.reach.first;
    if (goes_forward(made->reached)) ends.last = made->school.reach.last;
    edit.set_reach(*school, ends);
  } else {
    school = edit.add(std::move(made->school));
  }
  for (const auto& there : carried) edit.take(there.ping_index, there.mask, *school, true);
  return {};
}

Result<void> carry_out(Edit& edit, const DecideCommand& command) {
  int lost = 0;
  int found = 0;
  for (const Decision& decision : command.decisions) {
    if (!ping_at(edit.context(), decision.school.ping_time)) continue;  // another observation's
    if (const auto school = edit.find(decision.school)) {
      edit.decide(*school, decision);
      ++found;
    } else {
      edit.note(DiagnosticCode::decision_lost,
                fmt::format("{}: there is no school any more", place_of(decision.school)));
      ++lost;
    }
  }
  if (lost > 0 && found == 0 && command.decisions.size() == 1) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("{}: there is no school any more", place_of(command.decisions.front().school)));
  }
  return {};
}

Result<Applied> apply_watched(const JournalAct& act, const JournalState& state, const CommandContext& context) {
  const auto ping = ping_at(context, act.ping_time);
  if (!ping && !about_times(act.command)) return Applied{act, state};
  Edit edit(act, ping.value_or(-1), state, context);
  if (auto said = say_of_times(edit, act.command); !said) return pass_on(said);
  if (auto done = apply_to_ping(edit, act.command); !done) {
    Error error = done.error();
    if (error.where.ping < 0) error.where.ping = ping.value_or(-1);
    return tl::unexpected<Error>(std::move(error));
  }
  Applied applied{act, {}};
  if (edit.reached()) applied.act.command = *edit.reached();
  applied.state = edit.done();
  return applied;
}

Result<JournalState> apply(const JournalAct& act, const JournalState& state, const CommandContext& context) {
  auto applied = apply_watched(act, state, context);
  if (!applied) return pass_on(applied);
  return std::move(applied->state);
}

JournalState fold(std::span<const JournalLine> lines, JournalState state, const CommandContext& whole_seabed) {
  CommandContext context = whole_seabed;
  context.on_step = {};  // what the lines say is not for anyone to stop
  for (const JournalLine& line : lines) {
    const auto spans = times_of(line);
    const bool concerns = std::any_of(spans.begin(), spans.end(), [&](const TimeSpan& span) {
      return span.first == span.last ? ping_at(context, span.first).has_value()
                                     : overlaps(context, span.first, span.last);
    });
    const auto act = act_of(line);
    auto next = act ? apply(*act, state, context) : Result<JournalState>(pass_on(act));
    if (next) {
      state = std::move(*next);
    } else if (concerns) {
      state.notes.push_back({DiagnosticCode::decision_lost, "", -1, ping_at(context, line.ping_time).value_or(-1),
                             said_of(line) + next.error().text});
    }
  }
  return state;
}

}  // namespace sonar
