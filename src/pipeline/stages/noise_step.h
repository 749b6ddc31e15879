// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sonar {

/// What a ping's samples go through between the raw file and the Sv that schools are looked for in, in that order:
/// unfiltered Sv, the steps of flag_ping(), the median filter, and what is looked for in filtered Sv.
enum class NoiseStep : std::uint8_t {
  unfiltered,
  near_field,
  surface,
  dropouts,
  corrupted_packets,
  interference,
  impulse_noise,
  median,
  seabed,
  background,
};
inline constexpr std::array<std::string_view, 10> kNoiseStepNames{
    "unfiltered",   "near_field",    "surface", "dropouts", "corrupted_packets",
    "interference", "impulse_noise", "median",  "seabed",   "background"};

}  // namespace sonar
