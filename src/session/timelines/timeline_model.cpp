// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/timeline_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/refused_layer.h"
#include "session/timelines/timeline_painter.h"

namespace sonar {
namespace {

/// Opens the observation where needed.
void look_at_ping(Document& document, std::size_t observation, std::int64_t ping) {
  const auto& shown = document.shown();
  if ((!shown || shown->index() != observation) && !document.show(observation)) return;
  document.look_at(ping);
}

constexpr double kWheelStep = 1.25;           ///< of one notch
constexpr TimeNs kShortest = 10 * kSecondNs;  ///< that fills a timeline: a few pings

}  // namespace

double TimelinePlaces::x_of(TimeNs time) const {
  return plot.at(static_cast<double>(time - zero) / 1e9, plot.y.first).x;
}

TimeNs TimelinePlaces::time_at(double x_px) const {
  return zero + static_cast<TimeNs>(std::llround(plot.x_at(x_px) * 1e9));
}

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
      shown_.reset();
      pan_.reset();
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
    shown_.reset();
    pan_.reset();
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
  wish.shown = shown_;
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
  if (event.button == PointerButton::middle) {
    pan_ = Pan{event.at.x, part()};
    return;
  }
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
  switch (event.action) {
    case PointerAction::press:
      return press(event, *there);
    case PointerAction::move:
      if (event.button == PointerButton::middle) return pan_to(event.at.x);
      if (event.button != PointerButton::left) {
        scrubbing_ = false;
        marking_from_.reset();
        pan_.reset();
        return;
      }
      if (marking_from_) return mark(*marking_from_, *there);
      if (scrubbing_) go_to(*there);
      return;
    case PointerAction::release:
      scrubbing_ = false;
      marking_from_.reset();
      pan_.reset();
      return;
    case PointerAction::wheel:
      return zoom(event.at.x, std::pow(kWheelStep, event.wheel_steps));
    case PointerAction::pan:
      pan_ = Pan{0.0, part()};
      pan_to(event.by.x);
      return pan_.reset();
    case PointerAction::zoom:
      return zoom(event.at.x, event.factor);
    case PointerAction::double_press:
      return show_all();
    case PointerAction::leave:
      return;
  }
}

void TimelineModel::show_all() {
  pan_.reset();
  if (!shown_) return;
  shown_.reset();
  update();
}

void TimelineModel::show_part(TimeNs first, TimeNs length) {
  const TimelineInterval& all = places_->all;
  if (length >= all.last - all.first) return show_all();
  first = std::clamp(first, all.first, all.last - length);
  const TimelineInterval to{first, first + length};
  if (shown_ == to) return;
  shown_ = to;
  update();
}

void TimelineModel::zoom(double x_px, double factor) {
  if (!places_) return;
  const TimelineInterval now = part();
  const auto length = static_cast<double>(now.last - now.first);
  const double share = std::clamp((x_px - places_->plot.place.x) / places_->plot.place.width, 0.0, 1.0);
  const double to = std::max(length / factor, static_cast<double>(kShortest));
  if (to >= length && factor > 1.0) return;
  show_part(now.first + static_cast<TimeNs>(share * (length - to)), static_cast<TimeNs>(to));
}

void TimelineModel::pan_to(double x_px) {
  if (!pan_ || !places_ || !shown_) return;
  const TimeNs length = pan_->part.last - pan_->part.first;
  const double share = (pan_->x - x_px) / places_->plot.place.width;
  show_part(pan_->part.first + static_cast<TimeNs>(share * static_cast<double>(length)), length);
}

/// A ping that is looked at from elsewhere comes into sight.
void TimelineModel::follow_ping() {
  const auto& shown = workspace_.document.shown();
  if (!shown_ || !places_ || !shown) return;
  const TimeNs time = shown->files().navigation[static_cast<std::size_t>(workspace_.document.ping())].time;
  if (time >= shown_->first && time <= shown_->last) return;
  const TimeNs length = shown_->last - shown_->first;
  show_part(time - length / 2, length);
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
