// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "view/image.h"

namespace sonar {

/// pan and zoom: two fingers on a touch pad.
enum class PointerAction : std::uint8_t { move, press, release, double_press, wheel, pan, zoom, leave };
enum class PointerButton : std::uint8_t { none, left, middle, right };

/// What a pointer did over a picture, in the picture's own pixels (those of its FrameDescription).
struct PointerEvent {
  PointerAction action = PointerAction::move;
  PointerButton button = PointerButton::none;  ///< of press and release; in moves the one that is held
  PixelPoint at;
  bool shift = false;
  bool control = false;
  bool alt = false;
  double wheel_steps = 0.0;  ///< away from the user is positive
  PixelPoint by{};           ///< of pan: what is shown goes so far with the fingers
  double factor = 1.0;       ///< of zoom: so many times larger about `at`
};

}  // namespace sonar
