// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace sonar {

/// Why a sample is not to be trusted; several reasons may hold at once. 0 = sound.
enum class SampleFlags : std::uint8_t {
  none = 0,
  near_field = 1,     ///< transducer ringing and self noise
  surface = 2,        ///< sea surface, or above it
  corrupted = 4,      ///< corrupted packets: a beam's stretch at a high level
  dropout = 8,        ///< the channel or the sample was not recorded
  interference = 16,  ///< high level over all beams at constant range
  impulse = 32,       ///< a few samples of one beam in one ping
  seabed = 64,        ///< behind the seabed's first echo, margin included
  low_snr = 128,      ///< below the background's margin
};

[[nodiscard]] constexpr SampleFlags operator|(SampleFlags a, SampleFlags b) {
  return static_cast<SampleFlags>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
[[nodiscard]] constexpr SampleFlags operator&(SampleFlags a, SampleFlags b) {
  return static_cast<SampleFlags>(static_cast<std::uint8_t>(a) & static_cast<std::uint8_t>(b));
}
constexpr SampleFlags& operator|=(SampleFlags& a, SampleFlags b) { return a = a | b; }
[[nodiscard]] constexpr bool any(SampleFlags flags) { return flags != SampleFlags::none; }

/// A mask's members never lie here: there is no water, or nothing that can be told from a boundary.
inline constexpr SampleFlags kNeverMember = SampleFlags::near_field | SampleFlags::surface | SampleFlags::seabed;
/// Members here are kept in the mask but not measured.
inline constexpr SampleFlags kFault =
    SampleFlags::corrupted | SampleFlags::interference | SampleFlags::dropout | SampleFlags::impulse;
/// What the masked median leaves out.
inline constexpr SampleFlags kNotFiltered = kNeverMember | kFault;

}  // namespace sonar
