// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"
#include "geo/sector.h"
#include "school/detect/noise_level.h"
#include "school/seabed/seabed.h"

namespace sonar {

/// One ping as detection and its judges see it; borrowed.
struct PingEcho {
  View3<const std::int16_t> sv;          ///< [fan][beam][sample] median-filtered Sv counts: they show where schools are
  View3<const std::int16_t> unfiltered;  ///< same shape
  View3<const SampleFlags> flags;        ///< same shape, seabed included
  const Sector& sector;
  Background background;  ///< noise of the unfiltered samples
  const Seabed& seabed;
  const WaterLevels& water;  ///< and what lies above it
  bool peaked = true;        ///< the filter looked at many beams: its loudest voxels are a school's peak, not fading
};

}  // namespace sonar
