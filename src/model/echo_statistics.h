// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "model/school.h"

namespace sonar {

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

}  // namespace sonar
