// SPDX-License-Identifier: Apache-2.0
#include "session/tools/seed_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

namespace sonar {
namespace {

/// How far down growths go.
bool same_depth(const GrowParams& a, const GrowParams& b) {
  return a.tolerance_db == b.tolerance_db && a.tolerance_opacity == b.tolerance_opacity && a.margin_db == b.margin_db;
}

}  // namespace

SeedTool::SeedTool(Workspace& workspace, AnimationDriver& animations)
    : workspace_(workspace), animations_(animations), params_(grow_params(workspace.select.values())) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.growth_curve.changed(), [this] { parameters_changed(false, params_); });
  listening_.to(workspace.tool.changed(), [this] { leave(); });
  listening_.to(workspace.select, [this](const SelectParams& params) {
    const GrowParams was = params_;
    const GrowParams now = grow_params(params);
    const bool depth = !same_depth(now, params_);
    const bool changed = depth || now.mode != params_.mode || now.connectivity != params_.connectivity;
    params_ = now;
    if (changed) parameters_changed(depth, was);
  });
}

SeedTool::~SeedTool() { animations_.stop("grow anew"); }

// --- what would be selected

void SeedTool::hover(const Voxel& voxel, bool shift, bool control) {
  place_ = Place{voxel, shift, control};
  over_ = true;
  show_place();
}

void SeedTool::leave() {
  over_ = false;
  drop_preview();
}

std::optional<std::size_t> SeedTool::school_under(const Voxel& voxel) const {
  const auto& document = workspace_.document;
  if (!document.shown() || !document.staged()) return std::nullopt;
  return school_of_voxel(document.state(), document.staged()->ping_index, document.shown()->sector(), voxel);
}

Result<GrowCommand> SeedTool::command_at(const Place& place) const {
  const auto& shown = workspace_.document.shown();
  GrowCommand command;
  command.grow = params_;
  command.growth_curve = workspace_.growth_curve();
  command.seeds = {seed_key(*shown, place.voxel)};
  if (!place.shift && !place.control) return command;
  const auto selected = workspace_.selected();
  if (!selected) {
    if (place.shift) return command;
    return fail(ErrorCode::usage, "no school is selected that this could be taken from");
  }
  command.to = place.control ? GrowTo::take_away : GrowTo::add;
  command.school = key_of(workspace_.document.state().schools[*selected]->masks, shown->context());
  return command;
}

void SeedTool::show_place() {
  const Document& document = workspace_.document;
  if (workspace_.tool() != ToolName::seed || !place_ || !document.shown() || !document.staged()) return;
  if (!place_->shift && !place_->control && school_under(place_->voxel)) {
    return say("click selects, double click follows");  // the read-out beside it names the school
  }
  auto command = command_at(*place_);
  if (!command) return say(command.error().text);
  show({document.shown(), document.staged(), state_of(document, document.shown()->index()), std::move(*command)}, 0);
}

void SeedTool::say(std::string text) {
  stale_ = asked_;
  workspace_.preview.set({workspace_.document.staged()->ping_index, nullptr, std::move(text), 0});
}

void SeedTool::drop_preview() {
  stale_ = asked_;
  workspace_.preview.set({});
}

void SeedTool::show(GrowthTrial trial, std::int64_t instead_of) {
  const auto begun = std::chrono::steady_clock::now();
  growing_.post_latest([this, trial = std::move(trial), instead_of, number = ++asked_, begun,
                        alive = std::weak_ptr<bool>(alive_)](const CancelToken&) {
    // Shown even where a later wish has come: while wishes come faster than growths something must be seen.
    Preview preview = preview_of(trial);
    preview.instead_of = instead_of;
    preview.grown_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
    workspace_.queue.post([this, number, alive, preview = std::move(preview)] {
      if (!alive.expired() && number > stale_) workspace_.preview.set(preview);
    });
  });
}

// --- what is selected

void SeedTool::press(const Voxel& voxel, bool shift, bool control, bool double_press) {
  finish_growing_anew();
  Document& document = workspace_.document;
  if (!document.shown() || !document.staged()) return;
  const std::size_t observation = document.shown()->index();
  place_ = Place{voxel, shift, control};
  over_ = true;
  const bool plain = !shift && !control;
  if (double_press) {
    if (!plain) return;  // the press before has done it
    if (pending_) {
      pending_->carry_on = true;
    } else if (school_under(voxel)) {
      carry_on(observation, document.staged()->ping_index, seed_key(*document.shown(), voxel));
    }
    return;
  }
  if (plain && school_under(voxel)) return select(voxel);
  auto command = command_at(*place_);
  if (!command) return document.tell(command.error().text);
  grow(std::move(*command), {});
}

void SeedTool::take_in(const Voxel& voxel) {
  finish_growing_anew();
  const Document& document = workspace_.document;
  if (!document.shown() || !document.staged()) return;
  auto command = command_at({voxel});
  if (!command) return;
  std::vector<PropagateCommand> followed;
  if (auto propagation =
          propagation_from(document.shown()->index(), document.staged()->ping_index, command->seeds.front())) {
    followed.push_back(std::move(*propagation));
  }
  grow(std::move(*command), std::move(followed));
}

/// In the ping on show.
void SeedTool::grow(GrowCommand command, std::vector<PropagateCommand> followed) {
  Document& document = workspace_.document;
  if (!document.shown()->recalibrated()) {
    if (auto why = too_weak(*document.staged()->filtered, document.shown()->grid(), command); !why.empty()) {
      return document.tell(std::move(why));
    }
  }
  act({document.shown()->index(), document.staged(), std::move(command), false, 0, document.staged()->ping_index,
       std::move(followed)});
}

void SeedTool::select(const Voxel& voxel) {
  const Document& document = workspace_.document;
  const auto under = school_under(voxel);
  workspace_.school.set(
      under ? std::optional(SchoolName{document.shown()->index(), document.state().schools[*under]->number})
            : std::nullopt);
}

void SeedTool::act(Pending what) {
  made_.reset();
  std::shared_ptr<JournalStep> step;
  if (what.instead_of != 0 || !what.followed.empty()) {
    step = std::make_shared<JournalStep>();
    step->instead_of = what.instead_of;
  }
  const auto ask = [&](const auto& command) {
    what.tickets.push_back(workspace_.document.act(what.observation, what.ping, command, step));
  };
  ask(what.command);
  for (const PropagateCommand& command : what.followed) ask(command);
  pending_ = std::move(what);
}

/// Of the school that has the seed in a ping, as far and both ways as is set; empty where it is to stay in its ping.
std::optional<PropagateCommand> SeedTool::propagation_from(std::size_t observation, std::int64_t ping,
                                                           const SeedKey& seed) const {
  const auto open = workspace_.document.open_observation(observation);
  const SelectParams& select = workspace_.select.values();
  if (!open || (!select.backwards && !select.forwards)) return std::nullopt;
  PropagateCommand command = propagation_as_set(workspace_);
  command.grow = params_;
  if (!select.backwards) command.reach_backward = 0;
  if (!select.forwards) command.reach_forward = 0;
  command.school = SchoolKey{open->context().times[static_cast<std::size_t>(ping)], seed.channel, seed.sample};
  return command;
}

void SeedTool::carry_on(std::size_t observation, std::int64_t ping, const SeedKey& seed) {
  if (auto command = propagation_from(observation, ping, seed)) {
    workspace_.document.act(observation, ping, std::move(*command));
  }
}

void SeedTool::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
      pending_.reset();  // its ticket is another's there
      return forget();
    case DocumentChange::observation:
      if (!same_observation(of_.lock(), workspace_.document.shown())) forget();
      return;
    case DocumentChange::state:
      return take_state();
    case DocumentChange::looking:
      return finish_growing_anew();  // while the ping that it was made for is still on show
    case DocumentChange::ping:
      finish_growing_anew();
      if (workspace_.tool() != ToolName::seed) return;
      if (over_) return show_place();
      place_.reset();
      return drop_preview();
    default:
      return;
  }
}

void SeedTool::forget() {
  const auto& shown = workspace_.document.shown();
  of_ = shown;
  state_ = shown ? state_of(workspace_.document, shown->index()) : nullptr;
  animations_.stop("grow anew");
  anew_.reset();
  made_.reset();
  dragged_.clear();
  place_.reset();
  stale_ = asked_;
}

void SeedTool::take_state() {
  const Document& document = workspace_.document;
  if (!document.shown()) return;
  JournalStatePtr before = std::exchange(state_, state_of(document, document.shown()->index()));
  take_own_act(std::move(before));
  follow_undo();
  if (made_ && !stands_last()) made_.reset();
  if (anew_ && (anew_->instead_of != 0 ? !made_ : anew_->before != state_)) anew_.reset();
  if (workspace_.tool() != ToolName::seed) return;
  if (over_) return show_place();
  if (!anew_) drop_preview();
}

void SeedTool::take_own_act(JournalStatePtr before) {
  const ChoicesShown& now = workspace_.document.choices();
  if (!pending_ || now.ticket == 0 || now.ticket != pending_->tickets[pending_->done]) return;
  if (now.done_line == 0) return pending_.reset();  // nor will be what was to follow
  if (pending_->done++ == 0) {
    if (pending_->instead_of == 0) pending_->before = std::move(before);
    pending_->first_line = now.done_line;
  }
  if (pending_->done == pending_->tickets.size()) take_made(*std::exchange(pending_, std::nullopt));
}

void SeedTool::take_made(const Pending& done) {
  const Document& document = workspace_.document;
  const JournalState& state = document.state(done.observation);
  made_ = Made{document.choices().done_line,
               done.observation,
               done.command,
               done.staged,
               done.before,
               done.number,
               done.ping,
               done.followed};
  const JournalLine& line = document.choices().lines->back();
  if (done.was) dragged_.push_back({line.step == 0 ? line.n : line.step, *done.was, done.command.grow});
  if (done.command.to == GrowTo::school) {
    const auto made = std::find_if(state.schools.begin(), state.schools.end(),
                                   [&](const auto& school) { return school->made_by == done.first_line; });
    if (made == state.schools.end()) return;
    made_->number = (*made)->number;
    workspace_.school.set(SchoolName{done.observation, made_->number});
  }
  if (done.carry_on) return carry_on(done.observation, done.staged->ping_index, done.command.seeds.front());
  // The slider went on while the act was done.
  if (!same_depth(params_, done.command.grow)) parameters_changed(true, done.command.grow);
}

}  // namespace sonar
