// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "base/array.h"
#include "model/mask.h"
#include "model/school.h"
#include "school/measure/measure_input.h"

namespace sonar {

/// How many schools of a ping reach for each voxel with the surroundings of their masks; kMember inside any mask.
struct EchoClaims {
  static constexpr std::uint8_t kMember = 255;
  Array3<std::uint8_t> count;
};
/// ping   sector, grid and pulse are read
/// masks  of all schools of the ping; no voxel in two
[[nodiscard]] EchoClaims echo_claims(const MeasureInput& ping, std::span<const PingMask* const> masks);

/// Echo of a whole school: what its mask holds and what lies below the mask's cut round it.
struct TotalEcho {
  double backscatter_m2 = kUnknown;  ///< sum of sv V above the water, m^2; unknown where nothing is heard
  double se_m2 = kUnknown;           ///< its standard error by fading, of the school's echo and of the water's
};

/// The sum over the mask widened by half a beam's width each way and 3 m along range, less the level of the water round
/// that (the median over beams of their means). A voxel that several schools reach for is shared among them in equal parts, members are their school's alone.
/// Boundaries, the beam-edge seabed echo round the mask, other schools' members and beams that hear more round the mask than its threshold tells are left out; faulty samples count as their sound neighbours do on average.
/// claims   null = the ping holds no other school
/// threads  pure
[[nodiscard]] TotalEcho total_echo(const MeasureInput& ping, const PingMask& mask, const EchoClaims* claims);

}  // namespace sonar
