// SPDX-License-Identifier: Apache-2.0
#include "session/timelines/time_window.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonar {
namespace {

constexpr double kWheelStep = 1.25;           ///< of one notch
constexpr TimeNs kShortest = 10 * kSecondNs;  ///< that fills a timeline: a few pings

}  // namespace

double TimelinePlaces::x_of(TimeNs time) const {
  return plot.at(static_cast<double>(time - zero) / 1e9, plot.y.first).x;
}

TimeNs TimelinePlaces::time_at(double x_px) const {
  return zero + static_cast<TimeNs>(std::llround(plot.x_at(x_px) * 1e9));
}

std::optional<bool> TimeWindow::take(const PointerEvent& event, const TimelinePlaces& places) {
  switch (event.action) {
    case PointerAction::press:
      if (event.button != PointerButton::middle) return std::nullopt;
      pan_ = Pan{event.at.x, shown_.value_or(places.all)};
      return false;
    case PointerAction::move:
      if (event.button == PointerButton::middle) return pan_to(event.at.x, places);
      pan_.reset();
      return std::nullopt;
    case PointerAction::release:
      pan_.reset();
      return std::nullopt;
    case PointerAction::wheel:
      return zoom(event.at.x, std::pow(kWheelStep, event.wheel_steps), places);
    case PointerAction::pan: {
      pan_ = Pan{0.0, shown_.value_or(places.all)};
      const bool moved = pan_to(event.by.x, places);
      pan_.reset();
      return moved;
    }
    case PointerAction::zoom:
      return zoom(event.at.x, event.factor, places);
    case PointerAction::double_press:
      return show_all();
    case PointerAction::leave:
      return std::nullopt;
  }
  return std::nullopt;
}

bool TimeWindow::show_all() {
  pan_.reset();
  return std::exchange(shown_, std::nullopt).has_value();
}

bool TimeWindow::follow(TimeNs time, const TimelinePlaces& places) {
  if (!shown_ || (time >= shown_->first && time <= shown_->last)) return false;
  const TimeNs length = shown_->last - shown_->first;
  return show_part(time - length / 2, length, places.all);
}

bool TimeWindow::show_part(TimeNs first, TimeNs length, const TimelineInterval& all) {
  if (length >= all.last - all.first) return show_all();
  first = std::clamp(first, all.first, all.last - length);
  const TimelineInterval to{first, first + length};
  if (shown_ == to) return false;
  shown_ = to;
  return true;
}

bool TimeWindow::zoom(double x_px, double factor, const TimelinePlaces& places) {
  const TimelineInterval now = shown_.value_or(places.all);
  const auto length = static_cast<double>(now.last - now.first);
  const double share = std::clamp((x_px - places.plot.place.x) / places.plot.place.width, 0.0, 1.0);
  const double to = std::max(length / factor, static_cast<double>(kShortest));
  if (to >= length && factor > 1.0) return false;
  return show_part(now.first + static_cast<TimeNs>(share * (length - to)), static_cast<TimeNs>(to), places.all);
}

bool TimeWindow::pan_to(double x_px, const TimelinePlaces& places) {
  if (!pan_ || !shown_) return false;
  const TimeNs length = pan_->part.last - pan_->part.first;
  const double share = (pan_->x - x_px) / places.plot.place.width;
  return show_part(pan_->part.first + static_cast<TimeNs>(share * static_cast<double>(length)), length, places.all);
}

}  // namespace sonar
