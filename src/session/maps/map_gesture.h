// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "view/maps/map_frame.h"
#include "view/pointer_event.h"

namespace sonar {

/// What a pointer does to a map: the wheel and a pinch zoom, dragging and two fingers pan, a double press shows everything again, and a press that
/// went nowhere is a click.
class MapGesture {
 public:
  enum class Did { nothing, moved, clicked };

  [[nodiscard]] const MapZoom& zoom() const { return zoom_; }
  /// place                of the map in the picture
  /// whole_metres_per_px  of the map that shows everything
  /// scale                pixels a unit of the window
  Did take(const PointerEvent& event, const PixelRect& place, double whole_metres_per_px, double scale = 1.0);
  /// Everything is shown again.
  void reset() { *this = {}; }

 private:
  struct Press {
    PixelPoint at;
    MapZoom zoom;
    bool moved = false;
  };
  MapZoom zoom_;
  std::optional<Press> press_;
};

}  // namespace sonar
