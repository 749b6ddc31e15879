// SPDX-License-Identifier: Apache-2.0
#include "session/maps/cursor_place.h"

#include <cmath>

#include "geo/geodesic.h"

namespace sonar {

std::optional<Geographic> cursor_place(const Workspace& workspace) {
  const auto& voxel = workspace.cursor();
  const auto& shown = workspace.document.shown();
  if (!voxel || !shown) return std::nullopt;
  const Sector& sector = shown->sector();
  if (voxel->fan < 0 || voxel->fan >= sector.fans() || voxel->beam < 0 || voxel->beam >= sector.beams() ||
      voxel->sample < 0 || voxel->sample >= sector.range().count) {
    return std::nullopt;
  }
  const PingNavigation& navigation = shown->files().navigation[static_cast<std::size_t>(workspace.document.ping())];
  if (!navigation.has_position() || !std::isfinite(navigation.heading_deg)) return std::nullopt;
  const Placement placement = shown->placement(workspace.document.ping());
  const Point<Sonar> place = levelled(sector.centre(voxel->fan, voxel->beam, voxel->sample), placement);
  return to_geographic(to_enu(place, placement.heading_rad), placement.transducer);
}

}  // namespace sonar
