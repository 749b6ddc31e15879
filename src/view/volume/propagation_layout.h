// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geo/geodesic.h"
#include "view/volume/mask_plan.h"
#include "view/volume/propagation_view.h"

namespace sonar {

// Where a propagation view has its panels, and what they show: one part of the sonar's frame, all at one scale.

/// A box in picture directions (right, up), m from the transducer.
struct PlanBox {
  double left = 1e300;
  double right = -1e300;
  double low = 1e300;
  double high = -1e300;
  void add(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    low = std::min(low, y);
    high = std::max(high, y);
  }
  [[nodiscard]] bool empty() const { return right < left; }
};

[[nodiscard]] MaskPlan plan_seen(const Sector& sector, const PingMask& mask, MaskAspect aspect);
/// What a plan lights.
[[nodiscard]] PlanBox box_of(const MaskPlan& plan, MaskAspect aspect);
/// Of the sector, in picture directions, m from the transducer.
[[nodiscard]] std::vector<PlanePoint> plan_outline(const Sector& sector, MaskAspect aspect);

/// What stands round the panels.
struct PanelWords {
  bool title = true;
  bool times = true;
  bool scale = true;
  bool pings = true;
};

struct PanelLayout {
  PixelRect area;  ///< of all panels
  PanelWords words;
  int columns = 1;
  double width = 0.0;  ///< of a panel, pixels
  double height = 0.0;
  double label_px = 0.0;  ///< above each
  double gap_px = 0.0;
  double px_per_m = 1.0;
  PlanePoint middle;  ///< of each panel, in picture directions, m from the transducer
  [[nodiscard]] PixelRect place(std::size_t panel) const;
  /// Where a point of the plan lies in the panel of that place.
  [[nodiscard]] PixelPoint at(const PlanePoint& point, const PixelRect& place) const;
};
/// errors  as propagation_view()
[[nodiscard]] Result<PanelLayout> panel_layout(const Sector& sector, std::span<const PropagationPanel> panels,
                                               const PropagationStyle& style, PixelSize size, const Theme& theme);

}  // namespace sonar
