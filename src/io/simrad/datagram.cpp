// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/datagram.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "io/simrad/fields.h"

namespace sonar::simrad {
namespace {

constexpr auto kKnownTypes = std::to_array<std::string_view>(
    {"RAW0", "NME0", "CON0", "CON1", "RAW1", "RAW3", "RAW4", "XML0", "TAG0", "SVP0", "MRU0",
     "MRU1", "FIL1", "BOT0", "DEP0", "IDX0", "SEN0", "TNF0", "EOP0", "VER0", "CDS0", "PIN1"});

}  // namespace

bool is_known_type(std::span<const std::byte, 4> type) {
  return std::any_of(kKnownTypes.begin(), kKnownTypes.end(),
                     [&](std::string_view known) { return std::memcmp(known.data(), type.data(), 4) == 0; });
}

std::string type_text(std::span<const std::byte, 4> type) {
  std::string text;
  for (const std::byte byte : type) {
    const char c = static_cast<char>(std::to_integer<unsigned char>(byte));
    text += c > 0x20 && c < 0x7f ? c : '?';
  }
  return text;
}

Frame inspect_length(std::span<const std::byte> bytes) {
  if (bytes.size() < 4) return Frame::need_more;
  const auto length = number_at<std::uint32_t>(bytes, 0);
  return length >= kMinLength && length <= kMaxLength ? Frame::sound : Frame::bad_length;
}

Frame inspect_head(std::span<const std::byte> bytes) {
  const Frame frame = inspect_length(bytes);
  if (frame != Frame::sound) return frame;
  if (bytes.size() < 8) return Frame::need_more;
  if (!is_known_type(bytes.subspan<4, 4>())) return Frame::bad_length;
  if (bytes.size() < kHeadBytes) return Frame::need_more;
  return time_from_filetime(number_at<std::uint64_t>(bytes, 8)) ? Frame::sound : Frame::bad_length;
}

std::size_t bytes_without_head(std::span<const std::byte> bytes) {
  constexpr std::size_t kDigit = 7;    // where it stands in a head
  constexpr std::size_t kLetters = 3;  // before it
  constexpr std::uint64_t kLow = 0x0101010101010101ULL;
  const auto value = [&](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
  std::size_t i = kDigit;
  while (i < bytes.size()) {
    // Eight bytes at once: is one of them '0' to '7'?
    if (i + sizeof(std::uint64_t) <= bytes.size()) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, sizeof(word));
      const std::uint64_t other = (word & (0xF8 * kLow)) ^ ('0' * kLow);
      if (((other - kLow) & ~other & (0x80 * kLow)) == 0) {
        i += sizeof(word);
        continue;
      }
    }
    for (const std::size_t end = std::min(i + sizeof(std::uint64_t), bytes.size()); i < end; ++i) {
      if ((value(i) & 0xF8U) != '0' || value(i - kLetters) - 'A' > 'Z' - 'A') continue;
      const bool head = is_known_type(bytes.subspan(i - kLetters).first<4>()) &&
                        inspect_length(bytes.subspan(i - kDigit)) == Frame::sound;
      if (head) return i - kDigit;
    }
  }
  return bytes.size() < kDigit ? 0 : bytes.size() - kDigit;
}

}  // namespace sonar::simrad
