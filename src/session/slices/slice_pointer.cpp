// SPDX-License-Identifier: Apache-2.0
// What pointers do to a slice, and what is laid over it at once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/slices/slice_model.h"
#include "session/slices/slice_places.h"
#include "view/slices/slice_cuts.h"

namespace sonar {
namespace {

constexpr double kZoomPerStep = 1.25;
constexpr double kLeastWidth_m = 2.0;  ///< degrees of a range slice
constexpr double kTurnPerStep_deg = 2.0;

}  // namespace

void SliceModel::pointer(const PointerEvent& event) {
  if (measure_.take(event, picture_.get(), scale())) return;
  switch (event.action) {
    case PointerAction::move:
      return move(event);
    case PointerAction::press:
      return press(event, false);
    case PointerAction::double_press:
      return press(event, true);
    case PointerAction::release:
      return release(event);
    case PointerAction::wheel:
      return turn_wheel(event);
    case PointerAction::pan:
      return pan(event.by);
    case PointerAction::zoom:
      return zoom(event.at, 1.0 / event.factor);
    case PointerAction::leave:
      return leave();
  }
}

void SliceModel::point(const PointerEvent& event) {
  pointer_ = event.at;
  const auto voxel = voxel_at(event.at);
  workspace_.cursor.set(voxel);
  if (const auto echo = echo_at(event.at)) workspace_.echo.set(echo);
  if (!on_seed() || panned_) return;
  if (voxel) {
    seed_.hover(*voxel, event.shift, event.control);
  } else {
    seed_.leave();
  }
}

void SliceModel::move(const PointerEvent& event) {
  if (panned_) {
    pan({event.at.x - panned_->x, event.at.y - panned_->y});
    panned_ = event.at;
  }
  if (brush_.drawing() && picture_) brush_.move(*picture_->map, on_map(event.at));
  point(event);
  if (on_brush() || section_) changed().tell();  // its ring, its line
}

void SliceModel::press(const PointerEvent& event, bool double_press) {
  workspace_.slice_in_use.set({kind_, extent_});
  if (event.button == PointerButton::middle) {
    panned_ = event.at;
    return;
  }
  if (event.button != PointerButton::left) return;
  if (workspace_.tool() == ToolName::section) {
    // A line may begin beside the sector.
    if (picture_ && inside(picture_->plot.place, event.at)) section_ = event.at;
    return;
  }
  const auto voxel = voxel_at(event.at);
  if (!voxel) return;
  if (event.alt) return seed_.select(*voxel);
  if (on_brush()) {
    brush_.press(*picture_->map, on_map(event.at), workspace_.tool() == ToolName::eraser, scale());
  } else if (on_seed()) {
    seed_.press(*voxel, event.shift, event.control, double_press);
  }
}

bool SliceModel::aim(PixelPoint at) {
  point({PointerAction::move, PointerButton::none, at});
  const auto voxel = voxel_at(at);
  const bool school = voxel && seed_.school_under(*voxel);
  if (school) seed_.select(*voxel);
  return school;
}

void SliceModel::release(const PointerEvent& event) {
  if (event.button == PointerButton::middle) panned_.reset();
  if (event.button == PointerButton::left) brush_.release();
  if (event.button == PointerButton::left) end_section(event.at);
}

void SliceModel::leave() {
  pointer_.reset();
  workspace_.cursor.set(std::nullopt);
  if (on_seed()) seed_.leave();
  changed().tell();
}

void SliceModel::turn_wheel(const PointerEvent& event) {
  workspace_.slice_in_use.set({kind_, extent_});
  if (event.control) return zoom(event.at, std::pow(kZoomPerStep, -event.wheel_steps));
  wheel_ += event.wheel_steps;
  const double whole = std::trunc(wheel_);
  wheel_ -= whole;
  if (whole == 0.0) return;
  const int by = static_cast<int>(std::clamp(whole, -1000.0, 1000.0));
  if (event.shift && kind_ == SliceKind::plane) return turn_plane(workspace_, kTurnPerStep_deg * by);
  step_slice(workspace_, kind_, by, event.shift);
}

void SliceModel::end_section(PixelPoint at) {
  if (!section_ || !picture_) return;
  const PixelPoint from = *std::exchange(section_, std::nullopt);
  if (workspace_.tool() != ToolName::section) return;  // it was cancelled meanwhile
  workspace_.tool.set(ToolName::seed);
  lay_section(workspace_, picture_->map->point_at(on_map(from)), picture_->map->point_at(on_map(at)));
}

void SliceModel::zoom(PixelPoint about, double factor) {
  if (!picture_ || !workspace_.document.shown()) return;
  // What was asked for last, though its picture may still be on the way.
  const SliceExtent now = extent_.value_or(picture_->map->extent());
  const PixelRect& plot = picture_->plot.place;
  const double tx = std::clamp((about.x - plot.x) / plot.width, 0.0, 1.0);
  const double ty = std::clamp((about.y - plot.y) / plot.height, 0.0, 1.0);
  const double width = (now.x1 - now.x0) * factor;
  const double height = (now.y1 - now.y0) * factor;
  const auto whole =
      whole_extent(workspace_.document.shown()->sector(), {picture_->map->view().slice, 0.0, std::nullopt});
  if (whole && width > (whole->x1 - whole->x0) && height > (whole->y1 - whole->y0)) return show_all();
  if (width < kLeastWidth_m) return;
  const double x = now.x0 + tx * (now.x1 - now.x0);
  const double y = now.y0 + ty * (now.y1 - now.y0);
  extent_ = SliceExtent{x - tx * width, y - ty * height, x + (1.0 - tx) * width, y + (1.0 - ty) * height};
  update();
}

void SliceModel::pan(PixelPoint by) {
  if (!picture_) return;
  const SliceExtent now = extent_.value_or(picture_->map->extent());
  const double dx = by.x * (now.x1 - now.x0) / picture_->plot.place.width;
  const double dy = by.y * (now.y1 - now.y0) / picture_->plot.place.height;
  extent_ = SliceExtent{now.x0 - dx, now.y0 - dy, now.x1 - dx, now.y1 - dy};
  update();
}

void SliceModel::show_all() {
  if (!extent_) return;
  extent_.reset();
  update();
}

std::string SliceModel::timing() const {
  const Preview& preview = workspace_.preview();
  const std::string picture = LivePicture::timing();
  return preview.mask ? fmt::format("{}, growth {:.1f} ms", picture, preview.grown_ms) : picture;
}

const std::vector<Overlay>& SliceModel::cut_lines() const {
  std::vector<Slice> others;
  for (const SliceKind kind : kSliceKinds) {
    if (kind == kind_ || !switched_on(workspace_, kind)) continue;
    others.push_back(live_slice(workspace_, kind, workspace_.document.ping()));
  }
  if (cuts_.in == picture_ && cuts_.others == others) return cuts_.lines;
  cuts_ = {picture_, std::move(others), {}};
  const PixelRect& plot = picture_->plot.place;
  for (const Slice& other : cuts_.others) {
    for (auto& line : slice_cut(*picture_->map, other)) {
      for (PixelPoint& p : line) p = {p.x + plot.x, p.y + plot.y};
      cuts_.lines.push_back({.line = std::move(line), .cross = {}, .circle_at = {}, .muted = true});
    }
  }
  return cuts_.lines;
}

std::vector<Overlay> SliceModel::overlays() const {
  if (!picture_ || !problem().empty() || !workspace_.document.shown()) return {};
  const PixelRect& plot = picture_->plot.place;
  std::vector<Overlay> over = cut_lines();
  if (const auto& cursor = workspace_.cursor(); cursor && !pointer_) {
    const auto at = picture_->carried(*cursor);
    if (at && inside(plot, *at)) over.push_back({{}, at, {}, 0.0});
  }
  if (pointer_ && section_ && workspace_.tool() == ToolName::section)
    over.push_back({{*section_, *pointer_}, {}, {}, 0.0});
  if (pointer_ && on_brush() && inside(plot, *pointer_)) {
    over.push_back({{}, {}, pointer_, workspace_.brush_px() * scale()});
  }
  for (Overlay& overlay : measure_.overlays(*picture_)) over.push_back(std::move(overlay));
  return over;
}

PointerShape SliceModel::pointer_shape() const {
  const ToolName tool = workspace_.tool();
  return tool == ToolName::measure || tool == ToolName::section ? PointerShape::cross : PointerShape::arrow;
}

}  // namespace sonar
