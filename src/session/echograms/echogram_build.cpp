// SPDX-License-Identifier: Apache-2.0
#include "session/echograms/echogram_build.h"

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "pipeline/stages/observe.h"
#include "session/looks/screen_theme.h"
#include "session/timelines/timeline_painter.h"
#include "view/echograms/stacked_timelines.h"

namespace sonar {
namespace {

constexpr double kTitleFrom_em = 22.0;  ///< a lower echogram has no room for a title
constexpr double kColoursFrom_em = 46.0;
constexpr double kTwoFrom_em = 24.0;  ///< so low, there is no room for a second one

/// What a picture points to while it is made.
struct Drawn {
  ProductPtr product;
  std::vector<EchogramSchool> schools;
  std::vector<RefusedEcho> refused;
  TimelineHeights heights;
};

ProductPtr head_of(const ObservationFiles& files) {
  return std::make_shared<const ObservationProduct>(observation_head(files));
}

Drawn drawn_beams(const EchogramWish& wish) {
  Drawn out;
  const OpenObservation& open = *wish.open;
  const EchogramOf& of = wish.of.name.of;
  out.product = wish.product ? wish.product : head_of(open.files());
  const RowsOfPing rows = [&](std::int64_t ping) { return echogram_rows(open.sector(), open.placement(ping), of); };
  EchogramRange range;
  if (wish.of.echogram) {
    range = wish.of.echogram->range();
  } else {
    std::vector<Placement> placements;
    for (std::int64_t i = 0; i < open.pings(); ++i) placements.push_back(open.placement(i));
    range = echogram_range(open.sector(), placements, of);
  }
  out.heights = heights_of(range);
  if (wish.display.masks) out.schools = echogram_schools(*out.product, rows, range, 0, open.pings());
  std::erase_if(out.schools,
                [&](const EchogramSchool& school) { return !wish.display.rejected && school.status == "rejected"; });
  if (wish.refused) out.refused = echogram_refused(*wish.refused, open.grid(), rows, 0, open.pings());
  return out;
}

Drawn drawn_channel(const SurveyFiles& survey, const EchogramSoFar& of) {
  Drawn out;
  out.product = head_of(survey.observations[of.name.observation]);
  out.heights = of.echogram ? heights_of(of.echogram->range()) : TimelineHeights{0.0, 100.0};
  return out;
}

TimelinePanel panel_of(const Drawn& drawn, const EchogramSoFar& of, const EchogramWish& wish, std::string text) {
  TimelinePanel panel;
  panel.observation.product = drawn.product.get();
  panel.observation.echogram = of.echogram.get();
  panel.observation.schools = drawn.schools;
  panel.observation.refused = drawn.refused;
  panel.observation.label = drawn.product->observation + ", " + text;
  panel.style.scale = wish.display.scale;
  panel.style.by_school = true;
  panel.style.raw_there = wish.survey->raw_gone.empty();
  panel.style.filtered = of.name.shown.filtered;
  panel.style.of = std::move(text);
  panel.style.outlined = true;
  panel.style.height = of.name.of.height;
  panel.style.shown = wish.shown;
  panel.style.shown_heights = drawn.heights;
  return panel;
}

EchogramPlot plot_of(const TimelinePlot& plot, const EchogramSoFar& of) {
  return {{plot.plot, plot.zero, plot.all}, of};
}

}  // namespace

std::string echogram_text(const SurveyFiles& survey, const EchogramName& name, const OpenObservationPtr& open) {
  if (name.channel >= 0) return channel_text(survey.observations[name.observation], name.channel);
  return open ? echogram_text(open->sector(), open->grid().frequency_hz, name.of) : std::string();
}

Result<BuiltEchogram> built_echogram(const EchogramWish& wish, PixelSize size) {
  const Theme theme = dock_theme(size, wish.look);
  const bool of_beams = wish.of.name.channel < 0;
  const Drawn drawn = of_beams ? drawn_beams(wish) : drawn_channel(*wish.survey, wish.of);
  TimelinePanel panel = panel_of(drawn, wish.of, wish, echogram_text(*wish.survey, wish.of.name, wish.open));
  panel.observation.selected = wish.selected;
  panel.observation.chosen_echo = wish.chosen_echo;
  panel.observation.shadow = wish.shadow;
  if (wish.state && wish.open) add_marked(panel.observation, *wish.state, *wish.open);
  if (wish.heights) panel.style.shown_heights = wish.heights;
  const bool two = wish.below && size.height >= kTwoFrom_em * theme.text_px;
  const bool left_out = wish.below && !two;
  const double room_px = two ? upper_height(size) : size.height;
  panel.style.brief =
      left_out || room_px < kTitleFrom_em * theme.text_px || size.width < kColoursFrom_em * theme.text_px;
  if (!panel.style.brief) panel.observation.label.clear();  // the title says it
  // First what is missing: what the beam is may be cut.
  if (left_out) panel.observation.label.insert(0, "too low for two sounders; ");
  auto places = std::make_shared<EchogramPlaces>();
  places->heights = drawn.heights;
  if (!two) {
    auto frame = timeline(std::span(&panel.observation, 1), panel.style, size, theme);
    if (!frame) return pass_on(frame);
    const auto plot = timeline_plot(std::span(&panel.observation, 1), panel.style, size, theme);
    if (!plot) return pass_on(plot);
    places->above = plot_of(*plot, wish.of);
    return BuiltEchogram{std::move(*frame), std::move(places)};
  }
  const Drawn other = drawn_channel(*wish.survey, *wish.below);
  const TimelinePanel lower =
      panel_of(other, *wish.below, wish, echogram_text(*wish.survey, wish.below->name, nullptr));
  auto frame = stacked_timelines(panel, lower, size, theme);
  if (!frame) return pass_on(frame);
  const auto plots = stacked_plots(panel, lower, size, theme);
  if (!plots) return pass_on(plots);
  places->above = plot_of(plots->above, wish.of);
  places->below = plot_of(plots->below, *wish.below);
  return BuiltEchogram{std::move(*frame), std::move(places)};
}

}  // namespace sonar
