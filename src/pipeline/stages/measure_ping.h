// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/stages/engine.h"
#include "pipeline/stages/measure_schools.h"
#include "pipeline/stages/measured_pings.h"

namespace sonar {

/// A school in one ping; borrowed.
struct InPingRef {
  const SchoolMasks* school;
  const SchoolMasks::InPing* in_ping;
  std::size_t fadings;  ///< that it is measured again under, for standard errors
};

/// As in echo integration, what a human rejected takes no sound out of the beams.
[[nodiscard]] bool is_fish(const InPingRef& school);

/// Measures the schools of one ping, each as it is heard beside and behind the others.
/// area     two_way_area() of the engine's beams, sr
/// returns  in the order of the schools
[[nodiscard]] std::vector<MeasuredMask> measure_ping(const StagedPing& ping, const Engine& engine,
                                                     const std::vector<InPingRef>& schools, double area);

}  // namespace sonar
