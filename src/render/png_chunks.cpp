// SPDX-License-Identifier: Apache-2.0
#include "render/png_chunks.h"

#include <array>
#include <cmath>

namespace sonar {
namespace {

constexpr std::size_t kChunkFrame = 12;  // length, type, check sum

std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < table.size(); ++n) {
    std::uint32_t c = n;
    for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1U) : c >> 1U;
    table[n] = c;
  }
  return table;
}

/// CRC-32 of ISO 3309, as PNG has it.
std::uint32_t crc_of(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> kTable = crc_table();
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (crc >> 8U);
  return crc ^ 0xFFFFFFFFU;
}

std::uint32_t number_at(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace

std::string png_number(std::uint32_t value, int bytes) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i) & 0xFFU);
  return out;
}

void add_png_chunk(std::string& to, const std::string& type, std::string_view data) {
  to += png_number(static_cast<std::uint32_t>(data.size()));
  const std::string body = type + std::string(data);
  to += body;
  to += png_number(crc_of(body));
}

Result<std::vector<PngChunk>> png_chunks(std::string_view png, const std::string& file) {
  const auto damaged = [&](std::size_t at) {
    return fail(ErrorCode::format, "damaged PNG picture", {file, static_cast<std::int64_t>(at)});
  };
  if (!png.starts_with(kPngSignature)) return damaged(0);
  std::vector<PngChunk> chunks;
  for (std::size_t at = kPngSignature.size(); at < png.size();) {
    if (png.size() - at < kChunkFrame) return damaged(at);
    const std::uint32_t length = number_at(png.substr(at));
    if (length > png.size() - at - kChunkFrame) return damaged(at);
    chunks.push_back({png.substr(at + 4, 4), png.substr(at + 8, length)});
    at += kChunkFrame + length;
  }
  if (chunks.empty() || chunks.front().type != "IHDR" || chunks.front().data.size() != 13) return damaged(0);
  return chunks;
}

std::string described_png(std::string_view png, double dots_per_inch,
                          const std::vector<std::pair<std::string, std::string>>& texts) {
  constexpr double kInchesPerMetre = 1.0 / 0.0254;
  constexpr std::size_t kBeforeOthers = 8 + kChunkFrame + 13;  // signature and IHDR
  std::string out(png.substr(0, kBeforeOthers));
  const std::string per_metre = png_number(static_cast<std::uint32_t>(std::lround(dots_per_inch * kInchesPerMetre)));
  add_png_chunk(out, "pHYs", per_metre + per_metre + '\1');
  for (const auto& [keyword, text] : texts) {
    // Behind the keyword: not compressed, of no language, no translated keyword.
    if (!text.empty()) add_png_chunk(out, "iTXt", keyword + std::string(5, '\0') + text);
  }
  return out.append(png.substr(kBeforeOthers));
}

}  // namespace sonar
