// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

#include "base/check.h"

namespace sonar::simrad {

static_assert(std::endian::native == std::endian::little, "the files are little-endian and are read as they lie");

/// A number at a byte offset; the caller has checked that it lies inside.
template <class T>
  requires std::is_arithmetic_v<T>
[[nodiscard]] T number_at(std::span<const std::byte> bytes, std::size_t offset) {
  SONAR_CHECK(offset + sizeof(T) <= bytes.size());
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

/// A 32-bit float as double; NaN for anything that is not finite.
[[nodiscard]] inline double float_at(std::span<const std::byte> bytes, std::size_t offset) {
  const auto value = static_cast<double>(number_at<float>(bytes, offset));
  return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

/// Text up to its first NUL, at most `size` bytes; ISO-8859-1 turned into UTF-8, control characters into spaces.
[[nodiscard]] inline std::string text_at(std::span<const std::byte> bytes, std::size_t offset, std::size_t size) {
  SONAR_CHECK(offset + size <= bytes.size());
  std::string text;
  for (const std::byte byte : bytes.subspan(offset, size)) {
    const auto c = std::to_integer<unsigned>(byte);
    if (c == 0) break;
    if (c < 0x20 || c == 0x7f) {
      text += ' ';
    } else if (c < 0x80) {
      text += static_cast<char>(c);
    } else {
      text += static_cast<char>(0xC0U | (c >> 6U));
      text += static_cast<char>(0x80U | (c & 0x3FU));
    }
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace sonar::simrad
