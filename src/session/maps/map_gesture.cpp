// SPDX-License-Identifier: Apache-2.0
#include "session/maps/map_gesture.h"

#include <cmath>

namespace sonar {
namespace {

constexpr double kStill_px = 3.0;  ///< a hand that clicks moves so far
constexpr double kStep = 1.25;     ///< of one notch of the wheel

}  // namespace

MapGesture::Did MapGesture::take(const PointerEvent& event, const PixelRect& place, double whole_metres_per_px,
                                 double scale) {
  const MapZoom before = zoom_;
  switch (event.action) {
    case PointerAction::wheel:
      zoom_ = zoomed_about(place, whole_metres_per_px, zoom_, event.at, std::pow(kStep, event.wheel_steps));
      break;
    case PointerAction::zoom:
      zoom_ = zoomed_about(place, whole_metres_per_px, zoom_, event.at, event.factor);
      break;
    case PointerAction::pan:
      zoom_ = dragged(whole_metres_per_px, zoom_, {}, event.by);
      break;
    case PointerAction::double_press:
      reset();
      break;
    case PointerAction::press:
      if (event.button != PointerButton::right) press_ = {event.at, zoom_, false};
      break;
    case PointerAction::move:
      if (!press_ || event.button == PointerButton::none) break;
      press_->moved =
          press_->moved || std::hypot(event.at.x - press_->at.x, event.at.y - press_->at.y) > kStill_px * scale;
      if (press_->moved) zoom_ = dragged(whole_metres_per_px, press_->zoom, press_->at, event.at);
      break;
    case PointerAction::release: {
      const bool clicked = press_ && !press_->moved && event.button == PointerButton::left;
      press_.reset();
      if (clicked) return Did::clicked;
      break;
    }
    case PointerAction::leave:
      break;
  }
  return zoom_ == before ? Did::nothing : Did::moved;
}

}  // namespace sonar
