// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/beam_grid.h"
#include "school/integrate/cells.h"

namespace sonar {

/// How a beam goes down: metres of depth for each metre of range.
struct BeamSlope {
  double upper = 0.0;      ///< of its cell's upper bound
  double axis = 0.0;       ///< of the beam
  double lower = 0.0;      ///< of its cell's lower bound; not less than upper
  double width_rad = 0.0;  ///< vertical, one-way, -3 dB; NaN = unknown
  friend bool operator==(const BeamSlope&, const BeamSlope&) = default;
};
[[nodiscard]] BeamSlope beam_slope(const Sector& sector, const BeamGrid& grid, const Placement& placement, int row);

/// Part of a voxel that lies in a cell.
struct VoxelPart {
  int cell = 0;  ///< range bin * channels + channel
  double share =
      0.0;            ///< of its volume, by its vertical extent: a ring between two depths has the volume of its height
  double beam = 0.0;  ///< share of the vertical two-way beam that lies in the channel; NaN = unknown
};

/// Where along a beam's slope depths lie: straight, or bent as levelled() bends places.
class DepthAlong {
 public:
  /// placement  of the ping; its roll and pitch are in the slopes already
  explicit DepthAlong(const Placement& placement);
  /// slope, range_m  of the straight path
  /// out             below the mean water line
  [[nodiscard]] double depth_m(double slope, double range_m) const;
  [[nodiscard]] bool bent() const { return ray_.rays != nullptr; }
  [[nodiscard]] double transducer_depth_m() const { return ray_.transducer_depth_m; }
  /// Of the places from first to last sample.
  [[nodiscard]] double deepest_m(const BeamSlope& slope, double farthest_m) const;

 private:
  Placement ray_;
};

/// The cells that each voxel of a beam lies in; those of samples that no cell takes are empty.
class DepthParts {
 public:
  /// channels  of the ping; deeper parts are left out, as is what lies above the first channel
  DepthParts(const BeamSlope& slope, const DepthAlong& along, const RangeAxis& range, const CellLayout& layout,
             int channels);
  [[nodiscard]] std::span<const VoxelPart> of(int sample) const {
    const auto i = static_cast<std::size_t>(sample);
    return {parts_.data() + first_[i], first_[i + 1] - first_[i]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<VoxelPart> parts_;
};

/// Share of a Gaussian two-way beam between two angles off its axis. The beam is one that sends as narrowly as it receives:
/// exp(-8 ln 2 (angle / width)^2), a standard deviation of 0.30 width.
/// width_rad  one-way, -3 dB
[[nodiscard]] double two_way_share(double from_rad, double to_rad, double width_rad);

}  // namespace sonar
