// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/shared_value.h"
#include "geo/frames.h"
#include "model/mask.h"
#include "school/detect/echo_pieces.h"
#include "school/judge/reason.h"
#include "school/mask_shape.h"
#include "school/runs.h"

namespace sonar {

/// What may be a school in one ping: association over pings reads nothing else.
struct Detection {
  PingMask mask;
  IndexBox box;
  Point<Sonar> centre;       ///< weighted by confidence x volume, m
  Covariance3 covariance{};  ///< of the members round the centre, sonar frame, m^2
  double volume_m3 = 0.0;    ///< sum of member cells
  double reference_db = 0.0;
  double threshold_db = 0.0;
  double evidence = 0.0;           ///< the most that a block of it reaches
  std::int32_t edge_flags = 0;     ///< EdgeFlags
  SharedValue<EchoPieces> pieces;  ///< in and round the mask; empty where it is very large
  Run loudest;                     ///< one voxel, where the filtered echo is loudest
};

/// What lay clearly above the background in one ping and was judged no school.
struct RefusedDetection {
  Detection detection;  ///< without a threshold; its mask is what lay above the background
  Reason reason;
};

}  // namespace sonar
