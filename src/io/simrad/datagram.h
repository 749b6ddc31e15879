// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/time.h"

namespace sonar::simrad {

/// Bytes of a datagram beside its body: two length words, type, time stamp.
inline constexpr std::size_t kFrameBytes = 20;
/// First length word, type and time stamp.
inline constexpr std::size_t kHeadBytes = 16;
inline constexpr std::uint32_t kMinLength = 12;
/// No datagram is longer; beyond it the length word is damaged.
inline constexpr std::uint32_t kMaxLength = std::uint32_t{64} << 20;

/// One whole datagram; the body is borrowed.
struct Datagram {
  std::uint64_t offset = 0;         ///< of its first length word
  std::uint32_t length = 0;         ///< the length word N; N + 8 bytes on disk
  std::string type;                 ///< four characters, unprintable ones as '?'
  TimeNs time = 0;                  ///< of its time stamp
  std::span<const std::byte> body;  ///< N - 12 bytes

  [[nodiscard]] std::uint64_t end() const { return offset + length + 8; }
};

/// What the first bytes at a place say, before the rest is there.
enum class Frame {
  sound,       ///< plausible length; the place of the second length word is known
  need_more,   ///< too few bytes to tell
  bad_length,  ///< the length word is impossible
};

/// Type words that readers know of; used to find the next sound datagram after damage.
[[nodiscard]] bool is_known_type(std::span<const std::byte, 4> type);
[[nodiscard]] std::string type_text(std::span<const std::byte, 4> type);

/// Looks at a length word.
[[nodiscard]] Frame inspect_length(std::span<const std::byte> bytes);

/// Whether a datagram may begin here, by its first 16 bytes: plausible length, known type, plausible date.
/// Decides as early as the bytes allow, so that the answer does not depend on how many there are.
[[nodiscard]] Frame inspect_head(std::span<const std::byte> bytes);
/// How many bytes can be passed over because no head with a possible length and a known type begins in them. Leaves 7
/// bytes at the end, whose heads are not whole.
[[nodiscard]] std::size_t bytes_without_head(std::span<const std::byte> bytes);

}  // namespace sonar::simrad
