// SPDX-License-Identifier: Apache-2.0
#include "model/local_frame.h"

#include <algorithm>
#include <cmath>

namespace sonar {
namespace {

bool placed(const PingNavigation& ping) {
  return ping.has_position() && std::isfinite(ping.heading_deg) && std::isfinite(ping.transducer_depth_m);
}

}  // namespace

std::optional<LocalFrame> LocalFrame::of(const ObservationProduct& product) {
  const auto first = std::ranges::find_if(product.pings, placed);
  if (first == product.pings.end()) return std::nullopt;
  return LocalFrame(first->transducer);
}

std::optional<LocalFrame::Ping> LocalFrame::ping(const PingNavigation& ping, const Placement& placement) const {
  return placed(ping) ? std::optional<Ping>(Ping(placement, origin_)) : std::nullopt;
}

LocalFrame::Ping::Ping(const Placement& ping, const Geographic& origin)
    : into_(ping.transducer, origin), placement_(ping) {}

Point<Enu> LocalFrame::Ping::place(const Point<Sonar>& p) const {
  const Point<Enu> about = to_enu(levelled(p, placement_), placement_.heading_rad);
  const PlanePoint at = into_.apply({about.x, about.y});
  return {at.x, at.y, about.z - placement_.transducer_depth_m};
}

}  // namespace sonar
