// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/sector.h"
#include "school/detect.h"

namespace sonar {

/// Whether a detection is a seabed of which too little is seen to fit a plane: a fan of it that the record's end cuts
/// off, or all beams and a lowest fan that sees it strongly and at one range throughout.
/// sv      [fan][beam][sample], median-filtered Sv counts
/// flags   same shape
[[nodiscard]] bool is_open_floor(const Detection& detection, const Sector& sector, View3<const std::int16_t> sv,
                                 View3<const SampleFlags> flags, const DetectParams& params);

}  // namespace sonar
