// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/lineage_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/looks/screen_theme.h"
#include "session/open/survey_schools.h"
#include "session/timelines/lineage_data.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

constexpr double kTitleFrom_em = 24.0;  ///< a lower one has no room for title and key

std::string pings_text(std::int64_t first, std::int64_t last) {
  return first == last ? fmt::format("ping {}", first) : fmt::format("pings {} to {}", first, last);
}

}  // namespace

std::int64_t LineageSight::ping_at(double x_px) const {
  const auto after = std::ranges::upper_bound(data.times, places.time_at(x_px));
  return std::max<std::int64_t>(0, after - data.times.begin() - 1);
}

std::optional<std::size_t> LineageSight::lane_at(PixelPoint at) const {
  if (!inside(drawn.plot.place, at)) return std::nullopt;
  return static_cast<std::size_t>(std::max(0.0, std::floor(drawn.plot.y_at(at.y))));
}

const LineageSchool* LineageSight::school_at(PixelPoint at) const {
  const auto lane = lane_at(at);
  if (!lane || *lane >= drawn.lanes.size()) return nullptr;
  return &*std::ranges::find(data.schools, drawn.lanes[*lane], &LineageSchool::school_id);
}

PixelPoint LineageSight::place_of(std::int64_t school_id, std::int64_t ping) const {
  const auto lane = std::ranges::find(drawn.lanes, school_id) - drawn.lanes.begin();
  const double x = places.x_of(data.times[static_cast<std::size_t>(ping)]);
  return {x, drawn.plot.at(0.0, static_cast<double>(lane) + 0.5).y};
}

LineageModel::LineageModel(Workspace& workspace) : LivePicture(workspace), workspace_(workspace) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.school.changed(), [this] { update(); });
  listening_.to(workspace.marked_interval.changed(), [this] { changed().tell(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
}

void LineageModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
    case DocumentChange::observation: {
      const auto& shown = workspace_.document.shown();
      const auto identity = shown ? shown->identity() : nullptr;
      if (shown_of_.lock() != identity || !identity) {
        sight_.reset();
        window_ = {};
        held_.reset();
        marking_from_.reset();
      }
      shown_of_ = identity;
      return update();
    }
    case DocumentChange::state:
      return update();
    case DocumentChange::looking:
    case DocumentChange::ping:
      if (const LineageSight* seen = current()) {
        const auto ping = static_cast<std::size_t>(workspace_.document.ping());
        if (ping < seen->data.times.size() && window_.follow(seen->data.times[ping], seen->places)) update();
      }
      return changed().tell();  // the playhead is an overlay
    case DocumentChange::measures:
    case DocumentChange::propagating:
    case DocumentChange::glance:
    case DocumentChange::progress:
    case DocumentChange::notice:
      return;
  }
}

LivePicture::Build LineageModel::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  const auto& shown = document.shown();
  const auto& states = document.choices().states;
  const auto state = shown ? states.find(shown->index()) : states.end();
  if (state == states.end() || !state->second || state->second->schools.empty()) {
    if (!look.panel) sight_.reset();
    return {};
  }
  std::optional<std::int64_t> selected;
  if (const auto& school = workspace_.school(); school && school->observation == shown->index()) {
    selected = school->number;
  }
  return [shown, state = state->second, events = document.found_events(shown->index()), selected, look,
          part = window_.shown()](PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    auto sight = std::make_shared<LineageSight>();
    sight->observation = shown->index();
    sight->data = lineage_data(*shown, *state, *events);
    sight->data.selected = selected;
    const Theme theme = dock_theme(size, look);
    LineageStyle style;
    style.brief = size.height < kTitleFrom_em * theme.text_px;
    style.shown = part;
    style.free_lane = !look.panel;
    auto drawn = lineage(sight->data, style, size, theme);
    if (!drawn) return pass_on(drawn);
    sight->drawn = std::move(*drawn);
    sight->places = {sight->drawn.plot, sight->drawn.zero, sight->drawn.all};
    show({sight->drawn.frame, std::nullopt, sight});
    return {};
  };
}

void LineageModel::take(const std::shared_ptr<const void>& detail) {
  sight_ = std::static_pointer_cast<const LineageSight>(detail);
}

const LineageSight* LineageModel::current() const {
  const auto& shown = workspace_.document.shown();
  return sight_ && problem().empty() && shown && shown->index() == sight_->observation ? sight_.get() : nullptr;
}

void LineageModel::show_all() {
  if (window_.show_all()) update();
}

void LineageModel::go_to(std::int64_t ping) {
  if (workspace_.document.ping() != ping) workspace_.document.look_at(ping);
}

void LineageModel::mark(std::int64_t to) {
  workspace_.marked_interval.set(
      MarkedInterval{current()->observation, std::min(*marking_from_, to), std::max(*marking_from_, to)});
}

void LineageModel::pointer(const PointerEvent& event) {
  const LineageSight* seen = current();
  if (seen == nullptr) return;
  if (const auto moved = window_.take(event, seen->places)) {
    held_.reset();
    if (*moved) update();
    return;
  }
  if (event.action == PointerAction::press) return press(event);
  if (event.action == PointerAction::release) return release(event.at);
  if (event.action == PointerAction::move) return move(event);
}

void LineageModel::press(const PointerEvent& event) {
  const LineageSight& seen = *current();
  if (event.button != PointerButton::left || !seen.lane_at(event.at)) return;
  const std::int64_t ping = seen.ping_at(event.at.x);
  if (event.shift) {
    marking_from_ = ping;
    return mark(ping);
  }
  scrubbing_ = true;
  const auto interval = workspace_.marked_interval();
  const bool in_it = interval && interval->observation == seen.observation && interval->first_ping <= ping &&
                     ping <= interval->last_ping;
  // The interval that a piece is dragged out of stays.
  if (!in_it) workspace_.marked_interval.set(std::nullopt);
  const std::size_t observation = seen.observation;
  if (const LineageSchool* school = seen.school_at(event.at)) {
    const std::int64_t number = school->school_id;
    if (std::ranges::binary_search(school->pings, ping)) held_ = Held{number, ping, event.at, event.at};
    workspace_.school.set(SchoolName{observation, number});
  }
  go_to(ping);
}

void LineageModel::move(const PointerEvent& event) {
  if (event.button != PointerButton::left) {
    held_.reset();
    marking_from_.reset();
    scrubbing_ = false;
    return;
  }
  const LineageSight& seen = *current();
  const std::int64_t ping = seen.ping_at(event.at.x);
  if (marking_from_) return mark(ping);
  if (held_) {
    held_->at = event.at;
    changed().tell();
    if (!would_do(*held_).empty()) return;
  }
  if (scrubbing_ && seen.lane_at(event.at)) go_to(ping);
}

void LineageModel::release(PixelPoint at) {
  marking_from_.reset();
  scrubbing_ = false;
  auto held = std::exchange(held_, std::nullopt);
  if (!held) return;
  changed().tell();
  held->at = at;
  if (would_do(*held).empty()) return;
  if (const LineageSchool* onto = current()->school_at(at)) return drop(*held, onto->school_id);
  drop_free(*held);
}

bool LineageModel::cancel_drag() {
  if (!held_) return false;
  held_.reset();
  scrubbing_ = false;
  changed().tell();
  return true;
}

std::optional<MarkedInterval> LineageModel::interval_of(const Held& held) const {
  const auto& marked = workspace_.marked_interval();
  const bool in_it = marked && current() != nullptr && marked->observation == current()->observation &&
                     marked->first_ping <= held.ping && held.ping <= marked->last_ping;
  return in_it ? marked : std::nullopt;
}

std::string LineageModel::would_do(const Held& held) const {
  const LineageSight* seen = current();
  if (seen == nullptr || !seen->lane_at(held.at)) return {};
  const LineageSchool* onto = seen->school_at(held.at);
  if (onto != nullptr && onto->school_id == held.school) return {};
  const auto interval = interval_of(held);
  const std::string piece = interval ? pings_text(interval->first_ping, interval->last_ping) + " of " : std::string{};
  if (onto != nullptr) {
    return fmt::format("{} {}school {} to school {}", interval ? "hand over" : "join", piece, held.school,
                       onto->school_id);
  }
  if (interval) return fmt::format("make {}school {} a school of its own", piece, held.school);
  return fmt::format("cut school {} at ping {}", held.school, held.ping);
}

std::optional<SchoolKey> LineageModel::key_of_school(std::int64_t number) const {
  const auto& shown = workspace_.document.shown();
  for (const auto& one : workspace_.document.state().schools) {
    if (one->number == number) return key_of(one->masks, shown->context());
  }
  return std::nullopt;  // it is no more, though the picture shows it still
}

void LineageModel::drop(const Held& held, std::int64_t onto) {
  const auto school = key_of_school(held.school);
  const auto other = key_of_school(onto);
  if (!school || !other) return;
  Document& document = workspace_.document;
  if (const auto interval = interval_of(held)) {
    const auto& times = document.shown()->context().times;
    document.act(held.ping, HandOverCommand{*school, *other, times[static_cast<std::size_t>(interval->first_ping)],
                                            times[static_cast<std::size_t>(interval->last_ping)]});
    workspace_.marked_interval.set(std::nullopt);
  } else {
    document.act(held.ping, MergeCommand{{*other, *school}});
  }
  workspace_.school.set(SchoolName{document.shown()->index(), onto});
}

void LineageModel::drop_free(const Held& held) {
  const auto school = key_of_school(held.school);
  if (!school) return;
  Document& document = workspace_.document;
  const auto interval = interval_of(held);
  if (!interval) return document.act(held.ping, SplitCommand{*school, {}});
  const auto& times = document.shown()->context().times;
  document.act(held.ping, HandOverCommand{*school,
                                          {},
                                          times[static_cast<std::size_t>(interval->first_ping)],
                                          times[static_cast<std::size_t>(interval->last_ping)]});
  workspace_.marked_interval.set(std::nullopt);
}

bool LineageModel::aim(PixelPoint at) {
  const LineageSight* seen = current();
  if (seen == nullptr || !seen->lane_at(at)) return false;
  const LineageSchool* school = seen->school_at(at);
  const std::int64_t ping = seen->ping_at(at.x);
  const bool of_school = school != nullptr;
  if (of_school) workspace_.school.set(SchoolName{seen->observation, school->school_id});
  go_to(ping);
  return of_school;
}

std::string LineageModel::hint(PixelPoint at) const {
  const LineageSight* seen = current();
  if (seen == nullptr || !seen->lane_at(at)) return {};
  const std::int64_t ping = seen->ping_at(at.x);
  const std::string when =
      fmt::format("ping {}, {} UTC", ping, clock_text(seen->data.times[static_cast<std::size_t>(ping)], true));
  const LineageSchool* school = seen->school_at(at);
  if (school == nullptr) return when + "\na bar that is dropped here becomes a school of its own";
  std::string text =
      fmt::format("{}, {}\n{}{}", title_of(workspace_.document, {seen->observation, school->school_id}), school->status,
                  when, std::ranges::binary_search(school->pings, ping) ? "" : ": not seen");
  for (const TrackEdge& edge : seen->data.edges) {
    if (edge.school_id == school->school_id) text += "\n" + edge_text(edge);
  }
  return text;
}

std::vector<Overlay> LineageModel::overlays() const {
  std::vector<Overlay> out;
  const LineageSight* seen = current();
  if (seen == nullptr) return out;
  const PixelRect& place = seen->drawn.plot.place;
  const double bottom = place.y + place.height;
  const auto x_of = [&](std::int64_t ping) {
    const auto last = std::ssize(seen->data.times) - 1;
    return seen->places.x_of(seen->data.times[static_cast<std::size_t>(std::clamp<std::int64_t>(ping, 0, last))]);
  };
  Overlay playhead;
  const double now = x_of(workspace_.document.ping());
  playhead.line = {{now, place.y}, {now, bottom}};
  playhead.clip = place;
  out.push_back(std::move(playhead));
  if (const auto& marked = workspace_.marked_interval(); marked && marked->observation == seen->observation) {
    const double from = x_of(marked->first_ping);
    // Up to where the bar of the last ping ends.
    const double to = std::max(from + 2.0, x_of(marked->last_ping + 1));
    Overlay box;
    box.line = {{from, place.y}, {to, place.y}, {to, bottom}, {from, bottom}, {from, place.y}};
    box.clip = place;
    out.push_back(std::move(box));
  }
  if (!held_) return out;
  const std::string does = would_do(*held_);
  if (does.empty()) return out;
  Overlay drag;
  drag.line = {held_->from, held_->at};
  drag.dashed = true;
  drag.text = does;
  drag.beside = {held_->at.x, held_->at.y, 1.0, 1.0};
  out.push_back(std::move(drag));
  return out;
}

}  // namespace sonar
