// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/timeline_painter.h"

#include <algorithm>
#include <string>
#include <utility>

#include "pipeline/stages/observe.h"
#include "session/looks/screen_theme.h"

namespace sonar {
namespace {

constexpr double kTitleFrom_em = 20.0;  ///< a lower timeline has no room for a title
constexpr double kColoursFrom_em = 46.0;

TimelineObservation drawn(const TimelineWish::Observation& wish, const ObservationProduct& product) {
  TimelineObservation out;
  out.product = &product;
  out.echogram = wish.echogram.get();
  out.selected = wish.selected;
  out.refused = *wish.refused;
  out.chosen_echo = wish.chosen_echo;
  if (wish.state && wish.open) add_marked(out, *wish.state, *wish.open);
  return out;
}

/// What begins while the observation goes on, or before it without being over.
void add_periods(TimelineObservation& drawn, const std::vector<Transect>& transects) {
  const auto& pings = drawn.product->pings;
  if (pings.empty()) return;
  for (const Transect& one : transects) {
    if (one.start_utc > pings.back().time || one.stop_utc < pings.front().time) continue;
    drawn.marks.push_back({std::max(one.start_utc, pings.front().time), std::string(name(one.type)), one.name});
  }
}

}  // namespace

void add_marked(TimelineObservation& drawn, const JournalState& state, const OpenObservation& observation) {
  for (const EventCommand& event : state.events) {
    drawn.marks.push_back({shown_time(observation, event.time), event.kind, event.text});
  }
  for (const BadPingsCommand& bad : state.bad_pings) {
    drawn.bad.push_back({shown_time(observation, bad.first), shown_time(observation, bad.last)});
  }
}

TimeNs shown_time(const OpenObservation& observation, TimeNs datagram_time) {
  const auto& times = observation.context().times;
  if (times.empty()) return datagram_time;
  const auto after = std::lower_bound(times.begin(), times.end(), datagram_time);
  auto i = static_cast<std::size_t>(after - times.begin());
  if (i == times.size()) --i;
  return datagram_time + (observation.files().navigation[i].time - times[i]);
}

TimeNs bad_until(const OpenObservation& observation, const BadPingsCommand& bad) {
  const auto& times = observation.context().times;
  const auto after = std::upper_bound(times.begin(), times.end(), bad.last);
  return after == times.end() ? shown_time(observation, bad.last) + 1
                              : observation.files().navigation[static_cast<std::size_t>(after - times.begin())].time;
}

Result<TimelinePainter::Painted> TimelinePainter::paint(const TimelineWish& wish, PixelSize size) {
  if (survey_ != wish.survey) {
    survey_ = wish.survey;
    heads_.clear();
  }
  std::vector<TimelineObservation> observations;
  for (const auto& one : wish.observations) {
    const ObservationProduct* product = one.product.get();
    if (product == nullptr) {
      auto head = heads_.find(one.index);
      if (head == heads_.end()) {
        head = heads_.emplace(one.index, observation_head(survey_->observations[one.index])).first;
      }
      product = &head->second;
    }
    observations.push_back(drawn(one, *product));
    add_periods(observations.back(), wish.transects);
  }
  const Theme theme = dock_theme(size, wish.look);
  TimelineStyle style;
  style.value = wish.maximum ? EchogramValue::maximum : EchogramValue::mean;
  style.filtered = wish.filtered;
  style.scale = wish.sv;
  style.by_school = true;
  style.raw_there = survey_->raw_gone.empty();
  style.brief = size.height < kTitleFrom_em * theme.text_px || size.width < kColoursFrom_em * theme.text_px;
  style.shown = wish.shown;
  auto frame = timeline(observations, style, size, theme);
  if (!frame) return pass_on(frame);
  const auto plot = timeline_plot(observations, style, size, theme);
  if (!plot) return pass_on(plot);
  return Painted{std::move(*frame),
                 std::make_shared<const TimelinePlaces>(TimelinePlaces{plot->plot, plot->zero, plot->all})};
}

}  // namespace sonar
