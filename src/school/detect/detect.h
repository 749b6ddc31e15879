// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/sector.h"
#include "model/mask.h"
#include "school/detect/detect_params.h"
#include "school/detect/detection.h"
#include "school/judge/ping_echo.h"

namespace sonar {

/// Schools of one ping, without a human: what hangs together of the blocks that lie above the background of the water, then a threshold
/// relative to each one's own reference; what falls apart there becomes several detections.
/// echo     kNeverMember voxels are never members
/// taken    voxels that a human gave to schools; null = none
/// refused  what lay as clearly above the background as a school must and is none is added, by its first voxel; null = nobody asks
/// out      sorted by first voxel; no voxel in two
/// threads  pure
/// cost     about 1 ms for 25 x 20 x 1320
[[nodiscard]] std::vector<Detection> detect(const PingEcho& echo, const DetectParams& params,
                                            const PingMask* taken = nullptr,
                                            std::vector<RefusedDetection>* refused = nullptr);

/// Fills in what a mask alone tells (box, centre, covariance, volume, edges): for masks that a human or a propagation
/// made, so that they can be tracked like detections.
[[nodiscard]] Detection describe_mask(PingMask mask, View3<const SampleFlags> flags, const Sector& sector);

}  // namespace sonar
