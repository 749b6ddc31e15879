// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"

namespace sonar {

/// What a PNG begins with.
inline constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);

/// A part of a PNG; views of its bytes.
struct PngChunk {
  std::string_view type;
  std::string_view data;
};

/// A number as PNG holds it: big-endian.
[[nodiscard]] std::string png_number(std::uint32_t value, int bytes = 4);
/// With length and check sum.
void add_png_chunk(std::string& to, const std::string& type, std::string_view data);
/// Check sums are left to whoever decodes the pixels.
/// errors  format: no PNG, or cut
[[nodiscard]] Result<std::vector<PngChunk>> png_chunks(std::string_view png, const std::string& file);

/// The same picture with its resolution (pHYs) and texts (iTXt) before the pixels.
/// png    complete
/// texts  keyword and UTF-8 text; empty ones are left out
[[nodiscard]] std::string described_png(std::string_view png, double dots_per_inch,
                                        const std::vector<std::pair<std::string, std::string>>& texts);

}  // namespace sonar
