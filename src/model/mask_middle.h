// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "model/mask.h"

namespace sonar {

/// The voxel in the middle of a mask.
struct MaskMiddle {
  int fan = 0;
  int beam = 0;
  int sample = 0;
};
/// Each voxel counts alike; empty of an empty mask.
[[nodiscard]] std::optional<MaskMiddle> mask_middle(const PingMask& mask, int beams);

}  // namespace sonar
