// SPDX-License-Identifier: Apache-2.0
// What lies at a place of a timeline.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "session/looks/screen_theme.h"
#include "session/review/refused_layer.h"
#include "session/timelines/timeline_model.h"
#include "session/timelines/timeline_painter.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

// Times the scale, as all that a hand reaches.
constexpr double kEventReach_px = 8.0;
constexpr double kMarkReach_px = 6.0;

}  // namespace

std::optional<SurveyPlace> TimelineModel::ping_at(PixelPoint at) const {
  const auto& shown = workspace_.document.shown();
  if (!places_ || !shown) return std::nullopt;
  const TimeNs time = places_->time_at(at.x);
  std::optional<SurveyPlace> nearest;
  TimeNs best = 0;
  for (const std::size_t index : observations()) {
    const auto& pings = shown->survey().observations[index].navigation;
    const auto after = std::lower_bound(pings.begin(), pings.end(), time,
                                        [](const PingNavigation& n, TimeNs t) { return n.time < t; });
    for (const auto step : {std::ptrdiff_t{-1}, std::ptrdiff_t{0}}) {
      const auto i = (after - pings.begin()) + step;
      if (i < 0 || i >= static_cast<std::ptrdiff_t>(pings.size())) continue;
      const TimeNs away = std::abs(pings[static_cast<std::size_t>(i)].time - time);
      // Where two sounders ran at one time the observation on show is meant.
      if (nearest && (away > best || (away == best && index != shown->index()))) continue;
      best = away;
      nearest = SurveyPlace{index, i};
    }
  }
  return nearest;
}

std::optional<ChosenMark> TimelineModel::mark_at(PixelPoint at) const {
  if (!places_ || !workspace_.document.shown()) return std::nullopt;
  std::optional<ChosenMark> found;
  double best = kMarkReach_px * scale();
  const TimeNs time = places_->time_at(at.x);
  for (const std::size_t index : observations()) {
    const auto open = workspace_.document.open_observation(index);
    if (!open) continue;
    const JournalState& state = workspace_.document.state(index);
    for (const EventCommand& event : state.events) {
      const double away = std::abs(places_->x_of(shown_time(*open, event.time)) - at.x);
      if (away > best) continue;
      best = away;
      found = ChosenMark{index, event};
    }
    if (found) continue;
    for (const BadPingsCommand& bad : state.bad_pings) {
      if (time >= shown_time(*open, bad.first) && time < bad_until(*open, bad)) found = ChosenMark{index, bad};
    }
  }
  return found;
}

std::optional<EchoName> TimelineModel::echo_at(PixelPoint at) const {
  const auto& shown = workspace_.document.shown();
  if (!places_ || !shown) return std::nullopt;
  double reach_px = mark_reach_px(dock_theme(size(), scale(), workspace_.dark()));
  std::optional<EchoName> nearest;
  for (const std::size_t index : observations()) {
    const auto& pings = shown->survey().observations[index].navigation;
    const RefusedPtr rows = refused_layer(workspace_, index);
    for (const RefusedSightings& echo : refused_sightings(*rows)) {
      const double x = places_->x_of(pings[static_cast<std::size_t>(echo.loudest->ping_index)].time);
      const double y = places_->plot.at(0.0, echo.loudest->range_m).y;
      const double away = std::hypot(x - at.x, y - at.y);
      if (!(away <= reach_px)) continue;
      reach_px = away;
      nearest = EchoName{index, echo.loudest->echo_id};
    }
  }
  return nearest;
}

std::string TimelineModel::hint(PixelPoint at) const {
  const auto there = ping_at(at);
  if (!there) return {};
  const auto& observation = workspace_.document.shown()->survey().observations[there->observation];
  const auto& navigation = observation.navigation[static_cast<std::size_t>(there->ping)];
  std::string text =
      fmt::format("{}, ping {}\n{} UTC", observation.name, there->ping, clock_text(navigation.time, true));
  if (const auto echo = echo_at(at)) text += "\n" + why_no_school(workspace_.document, *echo);
  const auto open = workspace_.document.open_observation(there->observation);
  if (!open) return text;
  for (const EventCommand& event : workspace_.document.state(there->observation).events) {
    if (std::abs(places_->x_of(shown_time(*open, event.time)) - at.x) > kEventReach_px * scale()) continue;
    text += fmt::format("\n{}{}{}", event.kind, event.text.empty() ? "" : ": ", event.text);
  }
  if (const auto found = mark_at(at); found && std::holds_alternative<BadPingsCommand>(found->what)) {
    text += "\nbad: takes no part in measures";
  }
  return text;
}

}  // namespace sonar
