// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "base/diagnostics.h"
#include "model/ping.h"

namespace sonar::simrad {

inline constexpr std::size_t kRaw0HeadBytes = 72;
/// No channel has more samples, offset included; an allocation per sample stays bounded.
inline constexpr int kMaxSamples = 1 << 20;

/// Extension of RAW0 in reduced files, behind the samples: this mark, then ReducedRow's five members, little-endian.
inline constexpr std::string_view kReducedMark = "SXR2";
inline constexpr std::size_t kReducedBytes = 24;
/// Files that were reduced earlier tell no open stretches, the last two members of each row.
inline constexpr std::string_view kReducedMark1 = "SXR1";
inline constexpr std::size_t kOpenBytes = 8;
/// Behind that, in one channel of a ping, what there is of these three in this order:
/// this mark, then ReducedSeabed's seven members, little-endian;
inline constexpr std::string_view kReducedSeabedMark = "SXB1";
inline constexpr std::size_t kReducedSeabedBytes = 4 + 7 * 8;
/// this mark, WaterLevels' block_samples, blocks and places, then as 4-byte numbers how many follow of stretch, level (and
/// reach), cells and patch, then these, little-endian. (Files that were reduced earlier have SXW1, levels by range alone,
/// SXW2, which tells no patches, or SXW3, whose blocks were places; all are passed over.)
inline constexpr std::string_view kReducedWaterMark = "SXW4";
inline constexpr std::string_view kReducedWaterMark3 = "SXW3";
inline constexpr std::string_view kReducedWaterMark2 = "SXW2";
inline constexpr std::string_view kReducedWaterMark1 = "SXW1";
inline constexpr std::size_t kReducedWaterHeadBytes = 32;
inline constexpr std::size_t kReducedWaterHeadBytes3 = 28;
inline constexpr std::size_t kReducedWaterHeadBytes2 = 24;
inline constexpr std::size_t kReducedWaterHeadBytes1 = 12;
/// this mark, a 4-byte number and so many ReducedChannel: the 4-byte channel number from 1, ReducedRow's members.
inline constexpr std::string_view kReducedShortMark = "SXL2";
inline constexpr std::string_view kReducedShortMark1 = "SXL1";
inline constexpr std::size_t kReducedShortHeadBytes = 8;
inline constexpr std::size_t kReducedShortBytes = 24;

struct Raw0 {
  ChannelPing head;                  ///< power_count is left empty: the bytes need not be aligned
  std::span<const std::byte> power;  ///< 2 bytes a sample
  const char* problem = nullptr;     ///< why the channel is not usable; nullptr = sound
  DiagnosticCode code = DiagnosticCode::bad_sample_counts;  ///< of the problem
  bool bad_attitude = false;                                ///< a motion value was not finite; it is 0 now

  [[nodiscard]] int count() const { return static_cast<int>(power.size() / 2); }
  /// Offset and stored samples: where the row ends.
  [[nodiscard]] int end() const { return head.offset + count(); }
};

/// Reads a RAW0 body: header, and where the power counts lie. Angles and complex samples are skipped.
[[nodiscard]] Raw0 parse_raw0(std::span<const std::byte> body);

}  // namespace sonar::simrad
