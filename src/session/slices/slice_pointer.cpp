// SPDX-License-Identifier: Apache-2.0
// What pointers do to a slice, and what is laid over it at once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/slices/slice_model.h"

namespace sonar {
namespace {

constexpr double kZoomPerStep = 1.25;
constexpr double kLeastWidth_m = 2.0;

/// The part of a line that lies in a rectangle, by cutting it at each side; empty where none does.
std::vector<PixelPoint> within(const PixelRect& rect, PixelPoint a, PixelPoint b) {
  double first = 0.0;
  double last = 1.0;
  const auto cut = [&](double start, double along, double low, double high) {
    if (along == 0.0) {
      if (start < low || start > high) last = -1.0;
      return;
    }
    const double t0 = (low - start) / along;
    const double t1 = (high - start) / along;
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  };
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  cut(a.x, dx, rect.x, rect.x + rect.width);
  cut(a.y, dy, rect.y, rect.y + rect.height);
  if (first > last) return {};
  return {{a.x + first * dx, a.y + first * dy}, {a.x + last * dx, a.y + last * dy}};
}

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
  if (on_brush()) changed().tell();  // its ring
}

void SliceModel::press(const PointerEvent& event, bool double_press) {
  if (event.button == PointerButton::middle) {
    panned_ = event.at;
    return;
  }
  const auto voxel = voxel_at(event.at);
  if (event.button != PointerButton::left || !voxel) return;
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
}

void SliceModel::leave() {
  pointer_.reset();
  workspace_.cursor.set(std::nullopt);
  if (on_seed()) seed_.leave();
  changed().tell();
}

void SliceModel::turn_wheel(const PointerEvent& event) {
  if (event.control) return zoom(event.at, std::pow(kZoomPerStep, -event.wheel_steps));
  wheel_ += event.wheel_steps;
  const double whole = std::trunc(wheel_);
  wheel_ -= whole;
  if (whole != 0.0) step(static_cast<int>(std::clamp(whole, -1000.0, 1000.0)));
}

void SliceModel::step(int by) {
  const auto& shown = workspace_.document.shown();
  if (!shown) return;
  SlicePlaces places = workspace_.slices();
  int& place = side_ == SliceSide::top ? places.fan : places.beam;
  const int count = side_ == SliceSide::top ? shown->sector().fans() : shown->sector().beams();
  place = std::clamp(place + by, 0, count - 1);
  workspace_.slices.set(places);
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
  const auto whole = whole_extent(workspace_.document.shown()->sector(), {slice(), 0.0, std::nullopt});
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

std::vector<Overlay> SliceModel::overlays() const {
  std::vector<Overlay> over;
  const auto& shown = workspace_.document.shown();
  if (!picture_ || !shown) return over;
  const PixelRect& plot = picture_->plot.place;
  const SlicePlaces& places = workspace_.slices();
  const bool top = side_ == SliceSide::top;
  // The other slice, from the first sample to the last.
  // A picture that is still of the slice before shows that one's.
  const Slice& drawn = picture_->map->view().slice;
  const int fan = top ? std::get<TopSlice>(drawn).fan : places.fan;
  const int beam = top ? places.beam : std::get<SideSlice>(drawn).beam;
  const int count = shown->sector().range().count;
  const auto far = picture_->place_of({fan, beam, count - 1});
  std::optional<PixelPoint> near;  // the first samples may lie behind the sonar
  for (int sample = 0; sample < count && !near; ++sample) near = picture_->place_of({fan, beam, sample});
  if (near && far) {
    if (auto line = within(plot, *near, *far); !line.empty()) over.push_back({std::move(line), {}, {}, 0.0});
  }
  if (auto cursor = workspace_.cursor(); cursor && !pointer_) {
    (top ? cursor->fan : cursor->beam) = top ? fan : beam;
    const auto at = picture_->place_of(*cursor);
    if (at && inside(plot, *at)) over.push_back({{}, at, {}, 0.0});
  }
  if (pointer_ && on_brush() && inside(plot, *pointer_)) {
    over.push_back({{}, {}, pointer_, workspace_.brush_px() * scale()});
  }
  for (Overlay& overlay : measure_.overlays(*picture_)) over.push_back(std::move(overlay));
  return over;
}

PointerShape SliceModel::pointer_shape() const {
  return workspace_.tool() == ToolName::measure ? PointerShape::cross : PointerShape::arrow;
}

}  // namespace sonar
