// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/timeline_model.h"

#include <algorithm>
#include <utility>

#include "session/review/refused_layer.h"
#include "session/timelines/timeline_painter.h"

namespace sonar {
namespace {

/// Opens the observation where needed.
void look_at_ping(Document& document, std::size_t observation, std::int64_t ping) {
  const auto& shown = document.shown();
  if ((!shown || shown->index() != observation) && !document.show(observation)) return;
  document.look_at(ping);
}

}  // namespace

TimelineModel::TimelineModel(Workspace& workspace, std::shared_ptr<Echograms> echograms, TimelineOf of)
    : LivePicture(workspace),
      workspace_(workspace),
      echograms_(std::move(echograms)),
      of_(of),
      painter_(std::make_shared<TimelinePainter>()) {
  listening_.to(workspace.document.changes(), [this](DocumentChange change) { hear(change); });
  listening_.to(workspace.school.changed(), [this] { update(); });
  listening_.to(workspace.echo.changed(), [this] { update(); });
  listening_.to(workspace.display, [this] { update(); });
  listening_.to(workspace.timelines, [this] { update(); });
  listening_.to(workspace.marked_interval.changed(), [this] { changed().tell(); });
  listening_.to(workspace.mark.changed(), [this] { changed().tell(); });
  listening_.to(workspace.dark.changed(), [this] { update(); });
  listening_.to(workspace.transects.changed(), [this] { update(); });
  listening_.to(echograms_->changed(), [this] {
    // Nobody looks: what is being filled may rest.
    if (!seen() && !on_page()) echograms_->want(this, {});
    update();
  });
}

TimelineModel::~TimelineModel() { echograms_->want(this, {}); }

void TimelineModel::hear(DocumentChange change) {
  switch (change) {
    case DocumentChange::survey:
      places_.reset();
      marking_from_.reset();
      window_ = {};
      workspace_.marked_interval.set(std::nullopt);
      return update();
    case DocumentChange::observation:
      return observation_changed();
    case DocumentChange::looking:
    case DocumentChange::ping:
      follow_ping();
      return changed().tell();  // the playhead is an overlay
    case DocumentChange::state:
    case DocumentChange::measures:
      return update();
    case DocumentChange::propagating:
    case DocumentChange::glance:
    case DocumentChange::progress:
    case DocumentChange::notice:
      return;
  }
}

void TimelineModel::observation_changed() {
  const auto& shown = workspace_.document.shown();
  const auto identity = shown ? shown->identity() : nullptr;
  if (of_ == TimelineOf::observation && shown_of_.lock() != identity) {
    places_.reset();
    window_ = {};
  }
  shown_of_ = identity;
  update();
}

std::vector<std::size_t> TimelineModel::observations() const {
  const auto& shown = workspace_.document.shown();
  if (!shown) return {};
  if (of_ == TimelineOf::observation) return {shown->index()};
  std::vector<std::size_t> all;
  const auto& observations = shown->survey().observations;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (observations[i].grid) all.push_back(i);
  }
  std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
    return observations[a].navigation.front().time < observations[b].navigation.front().time;
  });
  return all;
}

LivePicture::Build TimelineModel::build(const PictureLook& look) {
  const Document& document = workspace_.document;
  const auto& shown = document.shown();
  if (!shown) return {};
  TimelineWish wish;
  wish.survey = {shown, &shown->survey()};
  const TimelineLimits& limits = workspace_.timelines.values();
  std::vector<EchogramName> fill{EchogramName::of_all_beams(shown->index(), limits.filtered)};
  for (const std::size_t index : observations()) {
    TimelineWish::Observation& one = wish.observations.emplace_back();
    one.index = index;
    one.product = document.product(index);
    one.open = document.open_observation(index);
    if (const auto found = document.choices().states.find(index); found != document.choices().states.end()) {
      one.state = found->second;
    }
    const auto name = EchogramName::of_all_beams(index, limits.filtered);
    one.echogram = echograms_->of(name);
    if (workspace_.school() && workspace_.school()->observation == index) one.selected = workspace_.school()->number;
    one.refused = refused_layer(workspace_, index);
    one.chosen_echo = chosen_echo(workspace_, index);
    if (index != shown->index()) fill.push_back(name);
  }
  echograms_->want(this, std::move(fill));
  wish.transects = workspace_.transects().periods;
  wish.maximum = limits.maximum;
  wish.filtered = limits.filtered;
  wish.sv = limits.scale(workspace_.display.values().scale);
  wish.shown = window_.shown();
  wish.look = look;
  return [painter = look.panel ? std::make_shared<TimelinePainter>() : painter_, wish = std::move(wish)](
             PixelSize size, const CancelToken&, const Show& show) -> Result<void> {
    auto painted = painter->paint(wish, size);
    if (!painted) return pass_on(painted);
    show({std::move(painted->frame), std::nullopt, std::move(painted->places)});
    return {};
  };
}

std::string TimelineModel::incomplete() const {
  const SurveyFiles* survey = workspace_.document.survey();
  if (survey != nullptr && !survey->raw_gone.empty()) return {};
  const auto all = observations();
  const bool filtered = workspace_.timelines.values().filtered;
  const bool complete = std::all_of(all.begin(), all.end(), [this, filtered](std::size_t index) {
    return echograms_->complete(EchogramName::of_all_beams(index, filtered));
  });
  return complete ? std::string() : "the timeline is still being read";
}

void TimelineModel::take(const std::shared_ptr<const void>& detail) {
  places_ = std::static_pointer_cast<const TimelinePlaces>(detail);
}

void TimelineModel::mark(const SurveyPlace& from, const SurveyPlace& to) {
  // An interval lies in one observation: the one where it was begun.
  const auto& pings = workspace_.document.shown()->survey().observations[from.observation].navigation;
  std::int64_t last = to.ping;
  if (to.observation != from.observation) {
    last = to.observation > from.observation ? static_cast<std::int64_t>(pings.size()) - 1 : 0;
  }
  workspace_.marked_interval.set(
      MarkedInterval{from.observation, std::min(from.ping, last), std::max(from.ping, last)});
}

void TimelineModel::go_to(const SurveyPlace& there) {
  const auto& shown = workspace_.document.shown();
  if (shown->index() == there.observation && workspace_.document.ping() == there.ping) return;
  look_at_ping(workspace_.document, there.observation, there.ping);
}

void TimelineModel::press(const PointerEvent& event, const SurveyPlace& there) {
  if (event.button != PointerButton::left) return;
  if (event.shift) {
    marking_from_ = there;
    return mark(there, there);
  }
  scrubbing_ = true;
  workspace_.marked_interval.set(std::nullopt);
  workspace_.mark.set(mark_at(event.at));
  if (const auto echo = echo_at(event.at)) return go_to_echo(workspace_, *echo);
  go_to(there);
}

void TimelineModel::pointer(const PointerEvent& event) {
  const auto there = ping_at(event.at);
  if (!there) return;
  if (const auto moved = window_.take(event, *places_)) {
    if (*moved) update();
    return;
  }
  if (event.action == PointerAction::press) return press(event, *there);
  if (event.action == PointerAction::leave) return;
  if (event.action == PointerAction::release || event.button != PointerButton::left) {
    scrubbing_ = false;
    marking_from_.reset();
    return;
  }
  if (marking_from_) return mark(*marking_from_, *there);
  if (scrubbing_) go_to(*there);
}

void TimelineModel::show_all() {
  if (window_.show_all()) update();
}

/// A ping that is looked at from elsewhere comes into sight.
void TimelineModel::follow_ping() {
  const auto& shown = workspace_.document.shown();
  if (!places_ || !shown) return;
  const auto ping = static_cast<std::size_t>(workspace_.document.ping());
  if (window_.follow(shown->files().navigation[ping].time, *places_)) update();
}

bool TimelineModel::aim(PixelPoint at) {
  workspace_.mark.set(mark_at(at));
  if (const auto echo = echo_at(at)) {
    go_to_echo(workspace_, *echo);
    return true;
  }
  if (const auto there = ping_at(at)) look_at_ping(workspace_.document, there->observation, there->ping);
  return true;
}

std::vector<Overlay> TimelineModel::overlays() const {
  std::vector<Overlay> out;
  const auto& shown = workspace_.document.shown();
  if (!places_ || !shown) return out;
  const PixelRect& place = places_->plot.place;
  const auto& observations = shown->survey().observations;
  const auto x_of = [&](std::size_t observation, std::int64_t ping) {
    const auto& pings = observations[observation].navigation;
    return places_->x_of(pings[static_cast<std::size_t>(ping)].time);
  };
  const double bottom = place.y + place.height;
  const auto box = [&](double from, double to) {
    from = std::max(from, place.x);
    to = std::min(to, place.x + place.width);
    if (to < from) return;
    Overlay lines;
    lines.line = {{from, place.y}, {to, place.y}, {to, bottom}, {from, bottom}, {from, place.y}};
    out.push_back(std::move(lines));
  };
  const double now = x_of(shown->index(), workspace_.document.ping());
  if (now >= place.x - 0.5 && now <= place.x + place.width + 0.5) {
    Overlay playhead;
    playhead.line = {{now, place.y}, {now, bottom}};
    out.push_back(std::move(playhead));
  }
  const auto& marked = workspace_.marked_interval();
  if (marked && marked->observation < observations.size() &&
      (of_ == TimelineOf::survey || marked->observation == shown->index())) {
    const double from = x_of(marked->observation, marked->first_ping);
    box(from, std::max(from + 2.0, x_of(marked->observation, marked->last_ping)));
  }
  const auto& chosen = workspace_.mark();
  const auto open = chosen ? workspace_.document.open_observation(chosen->observation) : nullptr;
  if (open && (of_ == TimelineOf::survey || chosen->observation == shown->index())) {
    if (const auto* event = std::get_if<EventCommand>(&chosen->what)) {
      const double x = places_->x_of(shown_time(*open, event->time));
      box(x - 3.0, x + 3.0);
    } else {
      const auto& bad = std::get<BadPingsCommand>(chosen->what);
      const double from = places_->x_of(shown_time(*open, bad.first));
      box(from, std::max(from + 2.0, places_->x_of(bad_until(*open, bad))));
    }
  }
  return out;
}

}  // namespace sonar
