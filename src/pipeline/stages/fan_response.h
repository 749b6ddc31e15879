// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geo/sector.h"
#include "model/mask.h"
#include "model/school.h"
#include "pipeline/stages/engine.h"

namespace sonar {

// Each fan of a sonar sends at a frequency of its own: what a school echoes in each of its fans hints at its frequency
// response. Fans differ in tilt too, so that they see fish from other sides and other parts of the school.

/// What some voxels of one fan of one ping echo, the expected background taken off.
struct HeardFan {
  int fan = 0;
  std::int64_t samples = 0;         ///< heard: neither faulty nor without data
  double volume_m3 = 0.0;           ///< of these
  double mean_sv_per_m = kUnknown;  ///< linear, weighted by volume, m^-1; may be below 0
  friend bool operator==(const HeardFan&, const HeardFan&) = default;
};

/// Of every fan in which the mask has a heard voxel, by fan: the sums of the school's tables, fan by fan.
/// threads  pure
/// cost     linear in the mask's voxels
[[nodiscard]] std::vector<HeardFan> heard_fans(const PingMask& mask, const StagedPing& ping, const Sector& sector);

/// How far the water round a school reaches.
struct WaterRound {
  int beams = 3;        ///< to each side of it in a fan
  double range_m = 10;  ///< before and behind it
  int gap_beams = 1;    ///< next to it that count as neither
  double gap_m = 2;
};

/// The water round a school in a ping, in the school's own fans: in each, the box of beams and ranges that it takes there,
/// widened, without the school and a gap round it, without all other schools, and without what is no water or faulty.
/// schools  every mask of the ping, the school's own among them or not
[[nodiscard]] PingMask water_round(const PingMask& school, std::span<const PingMask* const> schools,
                                   const StagedPing& ping, const Sector& sector, const WaterRound& reach = {});

/// A fan's echo over several pings.
struct FanResponse {
  int fan = 0;
  std::int64_t pings = 0;        ///< in which it was heard
  std::int64_t samples = 0;      ///< of all of them
  double volume_m3 = 0.0;        ///< of all of them
  double sv_mean_db = kUnknown;  ///< of all samples: linear, weighted by volume
  double sv_p25_db = kUnknown;   ///< quartiles of the pings' means, nearest ranks; unknown below 4 pings
  double sv_p75_db = kUnknown;
  friend bool operator==(const FanResponse&, const FanResponse&) = default;
};

/// pings  heard_fans() of each
/// out    by fan, those that were heard
[[nodiscard]] std::vector<FanResponse> fan_response(std::span<const std::vector<HeardFan>> pings);

}  // namespace sonar
