// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "model/school.h"
#include "school/mask_shape.h"
#include "school/measure/measure_input.h"

namespace sonar {

/// Whether a sample is kept in a mask and takes no part in Sv.
[[nodiscard]] bool is_faulty(SampleFlags flags, std::int16_t count);

/// Echo of the members of a mask in one ping, the expected background taken off. Faulty members stand at the mean of the
/// others. Percentiles are nearest ranks over voxels; a level that is not above the background is unknown.
struct EchoStatistics {
  std::int64_t voxels = 0;
  std::int64_t heard = 0;        ///< of those: what is neither faulty nor without data
  double volume_m3 = 0.0;        ///< sum of the members' cells
  double heard_m3 = 0.0;         ///< of those that are heard
  double sv_mean_db = kUnknown;  ///< mean sv, linear, weighted by volume
  double sv_p5_db = kUnknown;
  double sv_p50_db = kUnknown;
  double sv_p95_db = kUnknown;
  double sv_max_db = kUnknown;
  double mean_sv_per_m = kUnknown;   ///< sv_mean_db linear, m^-1; may be below 0
  double backscatter_m2 = kUnknown;  ///< mean sv times volume: the sum of sigma_bs, without 4 pi
  double snr_db = kUnknown;          ///< of the echo over the background that was taken off

  friend bool operator==(const EchoStatistics&, const EchoStatistics&) = default;
};

/// each_run  told, for each run with a heard member, its row and the echo of those members, m^2; may be empty
/// uses      sv, flags, sector and background of the input
/// threads   pure; sums in the mask's order
/// cost      linear in the mask's voxels
[[nodiscard]] EchoStatistics echo_statistics(const MeasureInput& ping, const PingMask& mask,
                                             const std::function<void(int row, double echo_m2)>& each_run = {});

/// What a mask spans, from the corners of its cells, m.
struct MaskExtents {
  double length_m =
      kUnknown;  ///< along the horizontal axis of the larger variance, or square to it where that is longer
  double width_m = kUnknown;   ///< square to that
  double axis_deg = kUnknown;  ///< of the length, clockwise from true north, [0, 180)
  double depth_min_m = kUnknown;
  double depth_max_m = kUnknown;
  double range_min_m = kUnknown;
  double range_max_m = kUnknown;

  friend bool operator==(const MaskExtents&, const MaskExtents&) = default;
};

/// mask        not empty
/// covariance  of its members, sonar frame (MaskShape)
[[nodiscard]] MaskExtents mask_extents(const PingMask& mask, const Covariance3& covariance, const Sector& sector,
                                       const Placement& placement);

}  // namespace sonar
