// SPDX-License-Identifier: Apache-2.0
// What is selected grows anew while its parameters move, and undo brings both back.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "session/tools/seed_tool.h"

namespace sonar {

bool SeedTool::stands_last() const {
  const auto& lines = *workspace_.document.choices().lines;
  return made_ && !lines.empty() && lines.back().n == made_->line;
}

void SeedTool::parameters_changed(bool tolerance, const GrowParams& was) {
  const auto& staged = workspace_.document.staged();
  if (workspace_.document.busy()) return show_place();
  const bool here = staged && made_ && staged->ping_index == made_->staged->ping_index;
  if (here && stands_last()) {
    return grow_anew({made_->observation, made_->staged, made_->before, made_->command, made_->number, made_->line,
                      made_->ping, made_->followed, was});
  }
  if (!tolerance || !grow_selected_anew(was)) show_place();
}

/// False where something else is pointed at, or nothing is selected: the tolerance is that of the next click.
bool SeedTool::grow_selected_anew(const GrowParams& was) {
  const Document& document = workspace_.document;
  const auto selected = workspace_.selected();
  const auto& staged = document.staged();
  if (!selected || !staged || staged->ping_index != document.ping()) return false;
  const auto under = place_ ? school_under(place_->voxel) : std::nullopt;
  if (over_ && under != selected) return false;
  const StateSchool& school = *document.state().schools[*selected];
  const bool rejected = school.masks.decided.status == "rejected";
  GrowCommand command;
  command.to = GrowTo::replace;
  command.school = key_of(school.masks, document.shown()->context());
  if (school.grown && !rejected && in_ping(school.masks, school.grown->ping_index) != nullptr) {
    command.seeds = school.grown->grow.seeds;
    grow_anew({document.shown()->index(), staged, state_, std::move(command), school.number, 0,
               school.grown->ping_index, school.grown->followed, was});
    return true;
  }
  const auto* there = in_ping(school.masks, staged->ping_index);
  const auto seed =
      there == nullptr ? std::nullopt : best_seed(there->mask, *staged->filtered, document.shown()->grid());
  if (!seed || school.by_hand || rejected) {
    if (place_ && !under) return false;
    const char* why = school.by_hand ? "was shaped by hand" : rejected ? "is rejected" : "has no seed in this ping";
    say(fmt::format("school {} {}: the tolerance is that of the next click", school.number, why));
    return true;
  }
  command.seeds = {*seed};
  grow_anew(
      {document.shown()->index(), staged, state_, std::move(command), school.number, 0, staged->ping_index, {}, was});
  return true;
}

/// What carried a school through time, as it would be done now; as far as before.
std::vector<PropagateCommand> SeedTool::as_set(std::vector<PropagateCommand> followed, const SchoolKey& from) const {
  for (PropagateCommand& command : followed) {
    PropagateCommand now = propagation_as_set(workspace_);
    now.grow = params_;
    now.reach = command.reach;
    now.reach_backward = command.reach_backward;
    now.reach_forward = command.reach_forward;
    now.school = from;  // the voxel that named it before may be no member any more
    command = std::move(now);
  }
  return followed;
}

void SeedTool::grow_anew(Anew anew) {
  anew.command.grow = params_;
  anew.command.growth_curve = workspace_.growth_curve();
  const SeedKey& seed = anew.command.seeds.front();
  const TimeNs seeded = workspace_.document.shown()->context().times[static_cast<std::size_t>(anew.ping)];
  anew.followed = as_set(std::move(anew.followed), {seeded, seed.channel, seed.sample});
  rests_since_s_ = std::numeric_limits<double>::quiet_NaN();
  if (anew.staged->ping_index == anew.ping) {
    show({workspace_.document.shown(), anew.staged, anew.before, anew.command}, anew.number);
  } else {
    say(fmt::format("school {} grows anew from ping {}", anew.number, anew.ping));
  }
  if (anew_) anew.was = anew_->was;  // the same hand goes on
  anew_ = std::move(anew);
  animations_.run("grow anew", [this](double now_s) { return rest(now_s); });
}

bool SeedTool::rest(double now_s) {
  if (!anew_) return false;
  if (!(rests_since_s_ <= now_s) || workspace_.select.held()) rests_since_s_ = now_s;
  if (now_s - rests_since_s_ < kRest_s) return true;
  // Behind whatever waits to be shown: an act that is done but not yet known must not be the one that is undone.
  workspace_.queue.post([this, alive = std::weak_ptr<bool>(alive_)] {
    if (!alive.expired()) finish_growing_anew();
  });
  return false;
}

void SeedTool::finish_growing_anew() {
  if (!anew_) return;
  animations_.stop("grow anew");
  const Anew anew = *std::exchange(anew_, std::nullopt);
  if (workspace_.document.busy() || (anew.instead_of != 0 && !stands_last())) return;
  const auto of = workspace_.document.open_observation(anew.observation);
  if (!of) return;
  // What grows no more stays as it was.
  const StagedPingPtr seeds = anew.ping == anew.staged->ping_index ? anew.staged : of->cache().held(anew.ping);
  if (seeds && !try_growth({of, seeds, anew.before, anew.command})) return;
  Pending what{anew.observation, anew.staged, anew.command, false, anew.number, anew.ping, anew.followed};
  what.was = anew.was;
  what.instead_of = anew.instead_of;
  if (anew.instead_of != 0) what.before = anew.before;
  act(std::move(what));
}

/// The slider stands where the growth that holds now was grown; it grows nothing by that.
void SeedTool::follow_undo() {
  const ChoicesShown& now = workspace_.document.choices();
  const JournalLine* turn = line_done(now);
  if (turn == nullptr || (turn->command != "undo" && turn->command != "redo")) return;
  const std::int64_t target = turn->args->value("target", std::int64_t{0});
  const auto line = std::ranges::find(*now.lines, target, &JournalLine::n);
  if (line == now.lines->end()) return;
  const auto drag = std::ranges::find(dragged_, line->step == 0 ? line->n : line->step, &Dragged::step);
  if (drag == dragged_.end()) return;
  const GrowParams& to = turn->command == "undo" ? drag->before : drag->after;
  params_ = to;
  SelectParams select = workspace_.select.values();
  select.mode = to.mode;
  select.connectivity = to.connectivity;
  select.tolerance_db = to.tolerance_db;
  select.tolerance_opacity = to.tolerance_opacity;
  select.margin_db = to.margin_db;
  workspace_.select.assign(select);
}

}  // namespace sonar
