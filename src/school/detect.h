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
#include "school/background.h"
#include "school/detect_params.h"
#include "school/mask_shape.h"
#include "school/runs.h"
#include "school/seabed.h"

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
  std::int32_t edge_flags = 0;  ///< EdgeFlags
};

/// Schools of one ping, without a human: candidates at max(floor, background + margin), the background being the beams'
/// noise or the water at that range; components by runs, then a
/// threshold relative to each candidate's own reference; what falls apart there becomes several detections.
/// sv          [fan][beam][sample], median-filtered Sv counts: they show where schools are
/// unfiltered  same shape: settles which voxels are theirs (settle_members.h)
/// flags       same shape, seabed included; kNeverMember voxels are never members
/// background  of the unfiltered samples; rows without one use the floor alone
/// seabed      of this ping; flags hold its echo
/// taken       voxels that a human gave to schools; null = none
/// out         sorted by first voxel; no voxel in two
/// threads     pure
/// cost        about 1 ms for 25 x 20 x 1320
[[nodiscard]] std::vector<Detection> detect(View3<const std::int16_t> sv, View3<const std::int16_t> unfiltered,
                                            View3<const SampleFlags> flags, const Sector& sector,
                                            const Background& background, const DetectParams& params,
                                            const Seabed& seabed = {}, const PingMask* taken = nullptr);

/// What detection takes for background beside the mean noise: the noise's own record of it, or else
/// reverberation_counts() and noise_reach().
[[nodiscard]] WaterLevels water_levels(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                       const Background& noise, const DetectParams& params);

/// Fills in what a mask alone tells (box, centre, covariance, volume, edges): for masks that a human or a propagation
/// made, so that they can be tracked like detections.
[[nodiscard]] Detection describe_mask(PingMask mask, View3<const SampleFlags> flags, const Sector& sector);

}  // namespace sonar
