// SPDX-License-Identifier: Apache-2.0
#include "session/tools/slice_measure.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "view/slices/slice_area.h"

namespace sonar {
namespace {

using Shape = Measurement::Shape;

constexpr double kLassoStep_px = 3.0;  ///< a lasso's points lie no nearer: nobody draws finer

PixelPoint on_map(const SlicePicture& picture, PixelPoint at) {
  return {at.x - picture.plot.place.x, at.y - picture.plot.place.y};
}

/// The nearest place of the slice itself.
PixelPoint in_plot(const SlicePicture& picture, PixelPoint at) {
  const PixelRect& plot = picture.plot.place;
  return {std::clamp(at.x, plot.x, plot.x + plot.width), std::clamp(at.y, plot.y, plot.y + plot.height)};
}

/// Coordinates of the slice that stay when north comes up.
PixelPoint ship_up(const SlicePicture& picture, PixelPoint at) {
  const SliceView& view = picture.map->view();
  return turned_up(view.slice, picture.map->slice_coordinates(on_map(picture, at)), view.up_rad);
}

PixelPoint in_picture(const SlicePicture& picture, PixelPoint ship_up) {
  const SliceView& view = picture.map->view();
  const PixelPoint p = turned_up(view.slice, ship_up, -view.up_rad);
  const PixelPoint at = picture.map->pixel_of(p.x, p.y);
  return {at.x + picture.plot.place.x, at.y + picture.plot.place.y};
}

MeasuredEnd slice_end(const Workspace& workspace, const SlicePicture& picture, PixelPoint at) {
  return end_at(workspace, picture.map->point_at(on_map(picture, at)), picture.voxel_at(at));
}

}  // namespace

bool SliceMeasure::take(const PointerEvent& event, const SlicePicture* picture, double scale) {
  const bool left = event.button == PointerButton::left;
  if (event.action == PointerAction::release && left && drag_) {
    const bool moved = drag_->moved;
    drag_.reset();
    Measurement done = workspace_.measurement().value_or(Measurement{});
    if (moved && done.drawing) {
      done.drawing = false;
      workspace_.measurement.set(std::move(done));
    }
    return true;
  }
  if (event.action == PointerAction::move) {
    if (drag_ && picture != nullptr) move(event.at, *picture, scale);
    return false;  // the cursor follows all the same
  }
  const bool press = event.action == PointerAction::press || event.action == PointerAction::double_press;
  if (!press || !left || event.alt || workspace_.tool() != ToolName::measure) return false;
  workspace_.measurement.set(std::nullopt);
  drag_.reset();
  if (picture == nullptr || !has_ping(workspace_) || !inside(picture->plot.place, event.at)) return true;
  const Shape shape = event.control ? Shape::lasso : event.shift ? Shape::box : Shape::line;
  drag_ = Drag{shape, event.at, event.at, false};
  return true;
}

void SliceMeasure::begin(const SlicePicture& picture) {
  Measurement begun = of_ping(workspace_, Measurement::On::slice);
  begun.shape = drag_->shape;
  begun.drawing = true;
  begun.slice = picture.map->view().slice;
  begun.outline = {ship_up(picture, drag_->from)};
  if (begun.shape == Shape::line) {
    const MeasuredEnd from = slice_end(workspace_, picture, drag_->from);
    begun.ends = {from, from};
  }
  drag_->moved = true;
  workspace_.measurement.set(std::move(begun));
}

bool SliceMeasure::still_drawing(const SlicePicture& picture) const {
  const auto& measured = workspace_.measurement();
  return measured && measured->drawing && measured->slice == picture.map->view().slice &&
         on_show(workspace_, *measured) && workspace_.document.staged()->ping_index == measured->ping;
}

void SliceMeasure::move(PixelPoint at, const SlicePicture& picture, double scale) {
  if (!has_ping(workspace_)) return drag_.reset();
  if (!drag_->moved) {
    if (std::hypot(at.x - drag_->from.x, at.y - drag_->from.y) <= kMeasureBegins_px * scale) return;
    begin(picture);
  }
  if (!still_drawing(picture)) {
    // Escape, another ping or another slice has ended it.
    if (workspace_.measurement() && workspace_.measurement()->drawing) workspace_.measurement.set(std::nullopt);
    return drag_.reset();
  }
  const PixelPoint to = in_plot(picture, at);
  Measurement measured = *workspace_.measurement();
  if (measured.shape == Shape::lasso) {
    if (std::hypot(to.x - drag_->last.x, to.y - drag_->last.y) < kLassoStep_px * scale) return;
    drag_->last = to;
    measured.outline.push_back(ship_up(picture, to));
  } else if (measured.shape == Shape::box) {
    // Along the picture's own sides, whatever points up.
    const PixelPoint from = in_picture(picture, measured.outline.front());
    measured.outline = {measured.outline.front(), ship_up(picture, {to.x, from.y}), ship_up(picture, to),
                        ship_up(picture, {from.x, to.y})};
  } else {
    measured.outline = {measured.outline.front(), ship_up(picture, to)};
    measured.ends->back() = slice_end(workspace_, picture, to);
  }
  workspace_.measurement.set(figured(workspace_, std::move(measured)));
}

std::vector<Overlay> SliceMeasure::overlays(const SlicePicture& picture) const {
  const auto& measured = workspace_.measurement();
  if (!measured || !on_show(workspace_, *measured) || measured->slice != picture.map->view().slice) return {};
  std::vector<PixelPoint> at;
  for (const PixelPoint& p : measured->outline) at.push_back(in_picture(picture, p));
  return measured_overlays(*measured, at, picture.plot.place, workspace_.units());
}

}  // namespace sonar
