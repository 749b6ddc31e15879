// SPDX-License-Identifier: Apache-2.0
#include "view/echograms/stacked_timelines.h"

#include <cmath>
#include <iterator>
#include <span>
#include <utility>
#include <variant>

namespace sonar {
namespace {

constexpr double kUpperShare = 0.58;  ///< the first has more room: its title is above it

/// Both panels over one part of time.
struct Shared {
  TimelinePanel above;
  TimelinePanel below;
  PixelSize upper;
  PixelSize lower;
};

Result<Shared> shared(const TimelinePanel& above, const TimelinePanel& below, PixelSize size, const Theme& theme) {
  if (above.style.axis == TimelineAxis::log) {
    return fail(ErrorCode::usage, "two echograms have the time in common: draw them along time, not along the log");
  }
  const int upper = upper_height(size);
  Shared out{above, below, {size.width, upper}, {size.width, size.height - upper}};
  if (!above.style.shown) {
    const auto place = timeline_plot(std::span(&above.observation, 1), above.style, out.upper, theme);
    if (!place) return pass_on(place);
    out.above.style.shown = place->all;
  }
  out.below.style.axis = TimelineAxis::time;
  out.below.style.shown = out.above.style.shown;
  out.below.style.brief = true;
  return out;
}

void move_down(FrameDescription& frame, double by) {
  for (auto& item : frame.items) {
    if (auto* image = std::get_if<ImageItem>(&item)) image->place.y += by;
    if (auto* text = std::get_if<TextItem>(&item)) text->at.y += by;
    if (auto* clip = std::get_if<ClipItem>(&item); clip != nullptr && clip->place != PixelRect{}) clip->place.y += by;
    if (auto* path = std::get_if<PathItem>(&item)) {
      for (PathItem::Part& part : path->parts) {
        for (PixelPoint& point : part.points) point.y += by;
      }
    }
  }
}

}  // namespace

int upper_height(PixelSize size) { return static_cast<int>(std::lround(kUpperShare * size.height)); }

Result<FrameDescription> stacked_timelines(const TimelinePanel& above, const TimelinePanel& below, PixelSize size,
                                           const Theme& theme) {
  const auto both = shared(above, below, size, theme);
  if (!both) return pass_on(both);
  auto frame = timeline(std::span(&both->above.observation, 1), both->above.style, both->upper, theme);
  if (!frame) return frame;
  auto lower = timeline(std::span(&both->below.observation, 1), both->below.style, both->lower, theme);
  if (!lower) return lower;
  move_down(*lower, both->upper.height);
  frame->size = size;
  frame->items.insert(frame->items.end(), std::make_move_iterator(lower->items.begin()),
                      std::make_move_iterator(lower->items.end()));
  frame->bars.insert(frame->bars.end(), lower->bars.begin(), lower->bars.end());
  return frame;
}

Result<StackedPlots> stacked_plots(const TimelinePanel& above, const TimelinePanel& below, PixelSize size,
                                   const Theme& theme) {
  const auto both = shared(above, below, size, theme);
  if (!both) return pass_on(both);
  auto first = timeline_plot(std::span(&both->above.observation, 1), both->above.style, both->upper, theme);
  if (!first) return pass_on(first);
  auto second = timeline_plot(std::span(&both->below.observation, 1), both->below.style, both->lower, theme);
  if (!second) return pass_on(second);
  second->plot.place.y += both->upper.height;
  return StackedPlots{std::move(*first), std::move(*second)};
}

}  // namespace sonar
