// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "session/tools/measure_tool.h"
#include "view/maps/map_frame.h"

namespace sonar {

/// The measure tool on one map: a drag is a line, whose length and bearing are the geodesic's.
/// threads  the window's
class MapMeasure {
 public:
  enum class Did {
    nothing,  ///< the event is not the tool's
    taken,
    clicked,  ///< a press that went nowhere: what was measured is forgotten
  };
  explicit MapMeasure(Workspace& workspace) : workspace_(workspace) {}

  /// scale  pixels of the map's picture in a unit of the window
  Did take(const PointerEvent& event, const MapFrame& map, double scale);
  [[nodiscard]] std::vector<Overlay> overlays(const MapFrame& map) const;

 private:
  void move(PixelPoint at, const MapFrame& map, double scale);

  struct Drag {
    PixelPoint from;
    bool moved = false;
  };
  Workspace& workspace_;
  std::optional<Drag> drag_;
};

}  // namespace sonar
