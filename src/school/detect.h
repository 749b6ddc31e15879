// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/frames.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "school/detect_params.h"
#include "school/judge/ping_echo.h"
#include "school/mask_shape.h"
#include "school/runs.h"

namespace sonar {

/// What may be a school in one ping. Light-weight: association over pings reads nothing else.
struct Detection {
  PingMask mask;
  IndexBox box;
  Point<Sonar> centre;       ///< weighted by confidence x volume, m
  Covariance3 covariance{};  ///< of the members round the centre, sonar frame, m^2
  double volume_m3 = 0.0;    ///< sum of member cells
  double reference_db = 0.0;
  double threshold_db = 0.0;
  double evidence = 0.0;        ///< the most that a block of it reaches
  std::int32_t edge_flags = 0;  ///< EdgeFlags
};

/// Schools of one ping, without a human: what hangs together of the blocks that stand out of the water, then a threshold
/// relative to each one's own reference; what falls apart there becomes several detections.
/// echo     kNeverMember voxels are never members
/// taken    voxels that a human gave to schools; null = none
/// out      sorted by first voxel; no voxel in two
/// threads  pure
/// cost     about 1 ms for 25 x 20 x 1320
[[nodiscard]] std::vector<Detection> detect(const PingEcho& echo, const DetectParams& params,
                                            const PingMask* taken = nullptr);

/// Fills in what a mask alone tells (box, centre, covariance, volume, edges): for masks that a human or a propagation
/// made, so that they can be tracked like detections.
[[nodiscard]] Detection describe_mask(PingMask mask, View3<const SampleFlags> flags, const Sector& sector);

}  // namespace sonar
