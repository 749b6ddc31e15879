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

bool meets(const CommandContext& context, const TimeSpan& span) {
  return !context.times.empty() && span.first <= context.times.back() && span.last >= context.times.front();
}

}  // namespace

bool holds_here(const JournalAct& act, const CommandContext& context) {
  const About what = about(act.command);
  if (what == About::ping) return ping_at(context, act.ping_time).has_value();
  if (what == About::survey) return true;
  const std::vector<TimeSpan> spans = spoken_times(act.command);
  return std::ranges::any_of(spans, [&](const TimeSpan& span) { return meets(context, span); });
}

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

Result<void> carry_out(Edit& edit, const EventCommand& command) {
  edit.add_event(command);
  return {};
}

Result<void> carry_out(Edit& edit, const RemoveEventCommand& command) { return edit.remove_event(command.event); }

Result<void> carry_out(Edit& edit, const BadPingsCommand& command) {
  edit.call_bad(command);
  return {};
}

Result<void> carry_out(Edit& edit, const GoodPingsCommand& command) {
  edit.call_good(command);
  return {};
}

Result<void> carry_out(Edit& edit, const CalibrateCommand& command) {
  edit.calibrate(command.calibration);
  return {};
}

Result<Applied> apply_watched(const JournalAct& act, const JournalState& state, const CommandContext& context) {
  if (!holds_here(act, context)) return Applied{act, state};
  const std::int64_t ping = ping_at(context, act.ping_time).value_or(-1);
  Edit edit(act, ping, state, context);
  const auto done = std::visit([&](const auto& command) { return carry_out(edit, command); }, act.command);
  if (!done) {
    Error error = done.error();
    if (error.where.ping < 0) error.where.ping = ping;
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

JournalState fold(std::span<const ReadLine> lines, JournalState state, const CommandContext& whole_seabed) {
  CommandContext context = whole_seabed;
  context.on_step = {};  // what the lines say is not for anyone to stop
  for (const ReadLine& read : lines) {
    auto next = read.act ? apply(*read.act, state, context) : Result<JournalState>(pass_on(read.act));
    if (next) {
      state = std::move(*next);
      continue;
    }
    const std::vector<TimeSpan> spans = times_of(read);
    const bool concerns = std::ranges::any_of(spans, [&](const TimeSpan& span) {
      return span.first == span.last ? ping_at(context, span.first).has_value() : meets(context, span);
    });
    if (!concerns) continue;
    state.notes.push_back({DiagnosticCode::decision_lost, "", -1, ping_at(context, read.line.ping_time).value_or(-1),
                           said_of(read.line) + next.error().text});
  }
  return state;
}

JournalState fold(std::span<const JournalLine> lines, JournalState state, const CommandContext& context) {
  return fold(ReadJournal(lines).lines(), std::move(state), context);
}

JournalState fold_without_masks(std::span<const ReadLine> lines, std::span<const TimeNs> times) {
  CommandContext context;
  context.times.assign(times.begin(), times.end());
  JournalState state;
  for (const ReadLine& read : lines) {
    if (!read.act || needs_masks(read.act->command)) continue;
    if (auto next = apply(*read.act, state, context)) state = std::move(*next);
  }
  return state;
}

}  // namespace sonar
