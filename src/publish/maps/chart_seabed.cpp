// SPDX-License-Identifier: Apache-2.0
#include "publish/maps/chart_seabed.h"

#include <cmath>
#include <span>
#include <utility>

#include "geo/geodesic.h"
#include "geo/map_projection.h"
#include "io/depth_raster.h"

namespace sonar {
namespace {

constexpr double kReach = 1.1;  ///< of the patch, in ranges of the sonar
constexpr double kRead = 1.5;   ///< of what is read, in reaches: a turned square has far corners

bool same_place(const Placement& a, const Placement& b) {
  return a.transducer == b.transducer && a.heading_rad == b.heading_rad && a.transducer_depth_m == b.transducer_depth_m;
}

}  // namespace

Result<SeabedPatch> seabed_patch(const DepthGrid& grid, const Placement& ship, double reach_m, int nodes) {
  SeabedPatch patch{nodes, nodes, -reach_m, -reach_m, 2.0 * reach_m / (nodes - 1), {}};
  bool known = false;
  for (int iy = 0; iy < patch.ny; ++iy) {
    for (int ix = 0; ix < patch.nx; ++ix) {
      const Point<Sonar> at{patch.first_x_m + ix * patch.spacing_m, patch.first_y_m + iy * patch.spacing_m, 0.0};
      const double depth = grid.depth_at(to_geographic(to_enu(at, ship.heading_rad), ship.transducer));
      known = known || !std::isnan(depth);
      patch.depth_m.push_back(static_cast<float>(depth));
    }
  }
  if (!known) return fail(ErrorCode::mismatch, "no depth is known round the ship", {grid.source});
  return patch;
}

bool ChartSeabed::covers(const Place& place) const {
  if (!read_ || read_->raster != place.raster || read_->range_m != place.range_m) return false;
  const double away_m = geodesic(read_->ship.transducer, place.ship.transducer).distance_m;
  return away_m <= spare_ * kRead * kReach * place.range_m;
}

Result<std::shared_ptr<const SeabedPatch>> ChartSeabed::round(const std::filesystem::path& raster,
                                                              const PingNavigation& navigation, double range_m) {
  if (!navigation.has_position()) {
    return fail(ErrorCode::mismatch, "no seabed: the ping has no position", {raster.string()});
  }
  const Place place{raster, navigation.placement(), range_m};
  if (patch_ && patch_of_->raster == raster && patch_of_->range_m == range_m &&
      same_place(patch_of_->ship, place.ship)) {
    return *patch_;
  }
  const double reach_m = kReach * range_m;
  if (!covers(place)) {
    const auto extent = extent_of(std::span(&place.ship.transducer, 1));
    grid_ = read_depth_raster(raster, widened(*extent, kRead * reach_m * (1.0 + spare_)));
    read_ = place;
  }
  patch_of_ = place;
  if (!*grid_) {
    patch_ = pass_on(*grid_);
    return *patch_;
  }
  auto patch = seabed_patch(**grid_, place.ship, reach_m, nodes_);
  if (!patch) {
    patch_ = pass_on(patch);
  } else {
    patch_ = std::make_shared<const SeabedPatch>(std::move(*patch));
  }
  return *patch_;
}

}  // namespace sonar
