// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "base/result.h"
#include "model/depth_grid.h"
#include "model/navigation.h"
#include "view/volume/context_scene.h"

namespace sonar {

/// Depths round a ship on an even grid in the sonar frame, reach_m to each side.
/// nodes   along each side
/// errors  mismatch: nothing known there
[[nodiscard]] Result<SeabedPatch> seabed_patch(const DepthGrid& grid, const Placement& ship, double reach_m,
                                               int nodes = 121);

/// The seabed of a depth chart round one ping after another. A chart is read again only where the ship leaves what was
/// read of it.
/// threads  one at a time
class ChartSeabed {
 public:
  /// spare   how far beyond the patch a chart is read, in patches; more of it is read less finely
  /// nodes   of the patch, along each side
  explicit ChartSeabed(double spare = 0.0, int nodes = 121) : spare_(spare), nodes_(nodes) {}

  /// The same object where nothing has changed since the last call.
  /// range_m  of the sonar
  /// errors  mismatch: no position, nothing known there; as read_depth_raster(); given again without reading again
  [[nodiscard]] Result<std::shared_ptr<const SeabedPatch>> round(const std::filesystem::path& raster,
                                                                 const PingNavigation& navigation, double range_m);

 private:
  struct Place {
    std::filesystem::path raster;
    Placement ship;
    double range_m = 0.0;
  };
  [[nodiscard]] bool covers(const Place& place) const;

  double spare_;
  int nodes_;
  std::optional<Place> read_;  ///< where the chart was read
  std::optional<Result<DepthGrid>> grid_;
  std::optional<Place> patch_of_;
  std::optional<Result<std::shared_ptr<const SeabedPatch>>> patch_;
};

}  // namespace sonar
