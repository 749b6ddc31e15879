// SPDX-License-Identifier: Apache-2.0
#include "session/tools/map_measure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonar {

MapMeasure::Did MapMeasure::take(const PointerEvent& event, const MapFrame& map, double scale) {
  if (event.action == PointerAction::move && drag_) {
    move(event.at, map, scale);
    return Did::taken;
  }
  if (event.button != PointerButton::left) return Did::nothing;
  if (event.action == PointerAction::press && workspace_.tool() == ToolName::measure) {
    workspace_.measurement.set(std::nullopt);
    if (inside(map.place, event.at)) drag_ = Drag{event.at, false};
    return Did::taken;
  }
  if (event.action != PointerAction::release || !drag_) return Did::nothing;
  const bool moved = drag_->moved;
  drag_.reset();
  if (!moved) return Did::clicked;
  Measurement done = workspace_.measurement().value_or(Measurement{});
  if (done.drawing) {
    done.drawing = false;
    workspace_.measurement.set(std::move(done));
  }
  return Did::taken;
}

void MapMeasure::move(PixelPoint at, const MapFrame& map, double scale) {
  const bool begins = !drag_->moved;
  if (begins && std::hypot(at.x - drag_->from.x, at.y - drag_->from.y) <= kMeasureBegins_px * scale) return;
  // Escape has ended it.
  if (!begins && (!workspace_.measurement() || !workspace_.measurement()->drawing)) return;
  const PixelRect& place = map.place;
  const auto from = begins ? map.geographic(drag_->from) : workspace_.measurement()->ends->front().where;
  const auto to = map.geographic(
      {std::clamp(at.x, place.x, place.x + place.width), std::clamp(at.y, place.y, place.y + place.height)});
  if (!from || !to) return;
  drag_->moved = true;
  Measurement measured;
  measured.on = Measurement::On::map;
  measured.drawing = true;
  measured.ends.emplace();
  measured.ends->front().where = from;
  measured.ends->back().where = to;
  measured.line = line_figures(measured.ends->front(), measured.ends->back(), {}, true);
  workspace_.measurement.set(std::move(measured));
}

std::vector<Overlay> MapMeasure::overlays(const MapFrame& map) const {
  const auto& measured = workspace_.measurement();
  if (!measured || measured->on != Measurement::On::map) return {};
  const auto from = map.at(*measured->ends->front().where);
  const auto to = map.at(*measured->ends->back().where);
  if (!from || !to) return {};
  return measured_overlays(*measured, {*from, *to}, map.place, workspace_.units());
}

}  // namespace sonar
