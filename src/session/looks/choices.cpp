// SPDX-License-Identifier: Apache-2.0
#include "session/looks/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>
#include <utility>

#include "base/within_memory.h"

namespace sonar {
namespace {

constexpr TimeNs kMillisecondNs = 1'000'000;

}  // namespace

const JournalLine* line_done(const ChoicesShown& shown) {
  if (shown.done_line <= 0 || !shown.lines || shown.lines->empty()) return nullptr;
  const JournalLine& last = shown.lines->back();
  return last.n == shown.done_line ? &last : nullptr;
}

const JournalLine* line_undone(const ChoicesShown& shown) {
  const JournalLine* undo = line_done(shown);
  if (undo == nullptr || undo->command != "undo") return nullptr;
  const std::int64_t target = undo->args->value("target", std::int64_t{0});
  const auto found =
      std::find_if(shown.lines->begin(), shown.lines->end(), [&](const JournalLine& line) { return line.n == target; });
  return found == shown.lines->end() ? nullptr : &*found;
}

History Choices::own_history(const JournalPlace& place) {
  History history(first_number(place.place));
  for (const JournalLine& line : place.journal.lines) history.add(among_all(line, place.place));
  return history;
}

Choices::Choices(ChangeQueue& queue, JournalPlace place, Options options, Shown shown, Step step)
    : queue_(queue),
      options_(std::move(options)),
      shown_(std::move(shown)),
      step_(std::move(step)),
      place_(std::move(place)),
      history_(own_history(place_)) {}

Choices::~Choices() { stop(); }

/// Behind all that others have chosen: whoever holds an observation comes after those who held it, whatever the clocks of
/// two machines say.
TimeNs Choices::now() const {
  const TimeNs clock = options_.clock ? options_.clock() : 0;
  TimeNs time = clock - clock % kMillisecondNs;
  for (const JournalLine& line : place_.lines) {
    const bool own = place_of(line.n) == place_.place;
    time = std::max(time, own ? line.decided : line.decided + kMillisecondNs);
  }
  return time;
}

void Choices::run(std::function<Result<std::int64_t>()> job, ActTicket ticket) {
  ++waiting_;
  thread_.post([this, job = std::move(job), ticket](const CancelToken&) {
    const auto line = within_memory(job);
    let_go_but_looked_at();
    publish(line ? std::string{} : to_line(line.error()), line ? *line : 0, ticket);
  });
}

void Choices::publish(std::string failure, std::int64_t line, ActTicket ticket) {
  ChoicesShown shown;
  for (const auto& [index, of] : open_) {
    shown.states[index] = of.state;
    if (of.searched) shown.searched.insert(index);
  }
  // What was undone before this run, or before another observation was opened, has a name and no states.
  if (const auto lines = history_.undoable(); !lines.empty()) shown.undo_text = "Undo " + step_name(lines.back());
  if (const auto lines = history_.redoable(); !lines.empty()) shown.redo_text = "Redo " + step_name(lines.front());
  shown.names = names_;
  shown.lines = std::make_shared<std::vector<JournalLine>>(place_.lines);
  shown.failure = std::move(failure);
  shown.notices = std::exchange(notices_, {});
  shown.journal = place_.path;
  shown.done_line = line;
  shown.ticket = ticket;
  queue_.post([this, alive = std::weak_ptr<bool>(alive_), shown = std::move(shown)] {
    if (alive.expired()) return;
    --waiting_;  // an act is at work until it is shown
    shown_(shown);
  });
}

CommandContext Choices::OnObservation::context() const {
  CommandContext context = observation->context();
  context.earlier = earlier.get();
  return context;
}

void Choices::open(OpenObservationPtr observation, std::optional<std::vector<SchoolMasks>> detected,
                   std::shared_ptr<const EarlierSchools> earlier) {
  run([this, observation = std::move(observation), detected = std::move(detected),
       earlier = std::move(earlier)]() -> Result<std::int64_t> {
    open_[observation->index()] = {observation, detected.has_value(),
                                   state_before_detection(detected.value_or(std::vector<SchoolMasks>{})), nullptr,
                                   earlier};
    rebuild(observation->index());
    return 0;
  });
}

void Choices::grow(OpenObservationPtr observation) {
  thread_.post([this, observation = std::move(observation)](const CancelToken&) {
    const auto of = open_.find(observation->index());
    if (of != open_.end()) of->second.observation = observation;
  });
}

ActTicket Choices::act(std::size_t observation, std::int64_t ping_index, Command command,
                       std::shared_ptr<JournalStep> step) {
  stopping_ = false;
  const ActTicket ticket = ++tickets_;
  auto job = [this, observation, ping_index, command = std::move(command), step = std::move(step)]() mutable {
    if (step && step->broken) return Result<std::int64_t>(0);
    others_hold_ = false;
    auto line = carry_out(observation, ping_index, std::move(command), step.get());
    if (step && !line && !others_hold_) step->broken = true;  // what others hold is left out alone
    return line;
  };
  run(std::move(job), ticket);
  return ticket;
}

/// What a step did is what its first line did.
std::string Choices::step_name(std::int64_t n) const {
  const auto named = names_.find(n);
  std::string name = named == names_.end() ? std::string{} : named->second;
  const auto& lines = place_.lines;
  const auto of = std::find_if(lines.begin(), lines.end(), [n](const JournalLine& line) { return line.n == n; });
  if (of == lines.end() || of->step == 0) return name;
  if (!history_.replaced_by(of->step).empty() && !name.ends_with(" anew")) name += " anew";
  if (of->command != "detect") return name;
  const auto all =
      std::count_if(lines.begin(), lines.end(), [&](const JournalLine& line) { return line.step == of->step; });
  return all == 1 ? name : fmt::format("{} in {} observations", name, all);
}

void Choices::turn_back(bool undo) {
  run([this, undo] { return turn(undo); });
}

JournalStatePtr Choices::base_of(const OnObservation& of, const std::vector<JournalLine>& lines) {
  const bool asked = asks_for_detection(lines, of.observation->context().times);
  return std::make_shared<const JournalState>(asked ? of.detected : JournalState{});
}

/// Of what a line says nothing of the state stays the same one: nobody has to measure or draw it again.
JournalStatePtr Choices::after(const ReadLine& line, const OnObservation& of) {
  if (line.act && !holds_here(*line.act, of.observation->context())) return of.state;
  return std::make_shared<const JournalState>(fold({&line, 1}, *of.state, of.context()));
}

bool Choices::asks_to_detect(std::int64_t n) const {
  const auto& lines = place_.lines;
  return std::any_of(lines.begin(), lines.end(),
                     [&](const JournalLine& line) { return line.n == n && line.command == "detect"; });
}

void Choices::tell_replayed(std::size_t done, std::size_t total) {
  queue_.post_latest("journal replayed", [this, alive = std::weak_ptr<bool>(alive_), done, total] {
    if (alive.expired() || !options_.replayed) return;
    options_.replayed(static_cast<std::int64_t>(done), static_cast<std::int64_t>(total));
  });
}

/// Lines stay what they are: each is parsed once.
const ReadLine& Choices::read(const JournalLine& line) {
  const std::pair key(line.n, line.decided);
  const auto known = lines_read_.find(key);
  return known != lines_read_.end() ? known->second : lines_read_.emplace(key, read_line(line)).first->second;
}

void Choices::rebuild() {
  done_.clear();
  undone_.clear();
  const std::vector<JournalLine> lines = effective_lines(place_.lines);
  for (auto& [index, of] : open_) of.state = base_of(of, lines);
  for (const JournalLine& line : lines) {
    tell_replayed(done_.size(), lines.size());
    Turn turn{line.n, line.step, line.command, {}, {}};
    const ReadLine& act = read(line);
    for (auto& [index, of] : open_) {
      turn.before[index] = of.state;
      of.state = after(act, of);
      turn.after[index] = of.state;
    }
    if (act.act) turn.name = name_of(*act.act, turn);
    names_[turn.n] = turn.name;
    done_.push_back(std::move(turn));
  }
  for (const JournalLine& line : place_.lines) {
    if (names_.contains(line.n)) continue;
    if (const ReadLine& act = read(line); act.act) names_[line.n] = act_name(*act.act, {}, nullptr, nullptr);
  }
}

void Choices::rebuild(std::size_t index) {
  const std::vector<JournalLine> lines = effective_lines(place_.lines);
  const bool same = std::equal(lines.begin(), lines.end(), done_.begin(), done_.end(),
                               [](const JournalLine& line, const Turn& turn) { return line.n == turn.n; });
  if (!same) return rebuild();
  // The others stay as they are: a survey of a hundred observations must not be replayed a hundred times.
  OnObservation& of = open_.at(index);
  of.state = base_of(of, lines);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    tell_replayed(i, lines.size());
    const ReadLine& act = read(lines[i]);
    done_[i].before[index] = of.state;
    of.state = after(act, of);
    done_[i].after[index] = of.state;
    if (act.act) done_[i].name = name_of(*act.act, done_[i]);
    names_[done_[i].n] = done_[i].name;
  }
  // What was undone, and what was replaced, is known no more.
  for (Turn& turn : undone_) turn.before.erase(index);
  for (Turn& turn : done_) {
    for (Turn& replaced : turn.replaced) replaced.before.erase(index);
  }
}

std::string Choices::name_of(const JournalAct& act, const Turn& turn) const {
  for (const auto& [index, of] : open_) {
    const CommandContext& context = of.observation->context();
    if (!ping_at(context, act.ping_time)) continue;
    return act_name(act, context, turn.before.at(index).get(), turn.after.at(index).get());
  }
  return act_name(act, {}, nullptr, nullptr);
}

Result<void> Choices::write(const JournalLine& line) {
  const JournalLine own = as_written(line, place_.place);
  if (auto written = append_journal(place_.path.string(), place_.journal, own); !written) return written;
  place_.journal.lines.push_back(own);
  place_.lines.push_back(line);
  history_.add(line);
  return {};
}

CommandContext Choices::watched(std::size_t observation) {
  CommandContext context = open_.at(observation).context();
  context.on_step = [this, observation](std::int64_t ping_index, const PingMask& mask) {
    queue_.post([this, alive = std::weak_ptr<bool>(alive_), observation, ping_index, mask] {
      if (!alive.expired()) step_(observation, ping_index, mask);
    });
    return !stopping_.load();
  };
  return context;
}

Result<std::int64_t> Choices::carry_out(std::size_t observation, std::int64_t ping_index, Command command,
                                        JournalStep* step) {
  const auto at = open_.find(observation);
  if (at == open_.end()) return fail(ErrorCode::usage, "the observation is not open");
  if (ping_index < 0 || ping_index >= at->second.observation->pings()) {
    return fail(ErrorCode::usage, "there is no such ping");
  }
  if (auto held = hold(at->second.observation->survey(), observation); !held) return pass_on(held);
  std::vector<Turn> replaced;
  if (step != nullptr && step->instead_of != 0 && step->first == 0) {
    const std::vector<std::int64_t> last = history_.undoable();
    if (last.empty() || last.front() != step->instead_of || !stand_last(done_, last)) {
      return fail(ErrorCode::usage, "something else was done meanwhile");
    }
    replaced = take_last(last.size());
  }
  auto line = carry_out_upon(replaced, observation, ping_index, std::move(command), step);
  if (!line) put_back(std::move(replaced));
  return line;
}

/// replaced  turns that are taken back already, and become part of this one; empty afterwards where the journal was written
Result<std::int64_t> Choices::carry_out_upon(std::vector<Turn>& replaced, std::size_t observation,
                                             std::int64_t ping_index, Command command, JournalStep* step) {
  const OnObservation& on = open_.at(observation);
  const CommandContext& context = on.observation->context();
  JournalAct act{history_.next() + std::ssize(replaced), now(), options_.operator_name,
                 context.times[static_cast<std::size_t>(ping_index)], std::move(command)};
  Turn turn{act.n, 0, {}, {}, {}};
  for (const auto& [index, of] : open_) turn.before[index] = turn.after[index] = of.state;
  auto applied = apply_watched(act, *on.state, watched(observation));
  if (!applied) return pass_on(applied);
  act = std::move(applied->act);
  turn.after[observation] = std::make_shared<const JournalState>(std::move(applied->state));
  for (const auto& [index, of] : open_) {
    if (index == observation || !holds_here(act, of.observation->context())) continue;
    // One that cannot be done there says nothing of that observation.
    auto other = apply(act, *of.state, of.context());
    if (other) turn.after[index] = std::make_shared<const JournalState>(std::move(*other));
  }
  JournalLine line = line_of(act);
  // What the next start could not read must not be shown as done.
  ReadLine again = read_line(line);
  if (!again.act) return pass_on(again.act);
  if (!replaced.empty()) {
    turn.replaced = replaced;
    if (auto taken_back = write_replaced(replaced, *step); !taken_back) return pass_on(taken_back);
  }
  if (step != nullptr) line.step = step->first == 0 ? act.n : step->first;
  if (auto written = write(line); !written) {
    if (!turn.replaced.empty()) rebuild();
    return pass_on(written);
  }
  again.line.step = line.step;
  lines_read_.emplace(std::pair(line.n, line.decided), std::move(again));
  if (step != nullptr) step->first = line.step;
  turn.step = line.step;
  turn.name = name_of(act, turn);
  names_[act.n] = turn.name;
  for (const auto& [index, state] : turn.after) open_.at(index).state = state;
  done_.push_back(std::move(turn));
  undone_.clear();
  if (line.command != "detect") return act.n;
  // What was found lies under every other line; observations that it was not asked for stay as they are.
  for (const auto& [index, of] : open_) {
    if (asks_for_detection(std::span(&line, 1), of.observation->context().times)) rebuild(index);
  }
  return act.n;
}

}  // namespace sonar
