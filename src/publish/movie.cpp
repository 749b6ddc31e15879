// SPDX-License-Identifier: Apache-2.0
// Animated PNG (APNG 1.0): the chunks of single pictures, each behind a chunk that says when it is shown. Pixels are
// copied as they are compressed.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "publish/picture_files.h"

namespace sonar {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t kChunkFrame = 12;  // length, type, check sum

struct Chunk {
  std::string_view type;
  std::string_view data;
};

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

std::string big_endian(std::uint32_t value, int bytes = 4) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i) & 0xFFU);
  return out;
}

std::uint32_t number_at(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

void add_chunk(std::string& to, const std::string& type, std::string_view data) {
  to += big_endian(static_cast<std::uint32_t>(data.size()));
  const std::string body = type + std::string(data);
  to += body;
  to += big_endian(crc_of(body));
}

Result<std::vector<Chunk>> chunks_of(std::string_view png, const std::string& file) {
  const auto damaged = [&](std::size_t at) {
    return fail(ErrorCode::format, "damaged PNG picture", {file, static_cast<std::int64_t>(at)});
  };
  if (!png.starts_with(kSignature)) return damaged(0);
  std::vector<Chunk> chunks;
  for (std::size_t at = kSignature.size(); at < png.size();) {
    if (png.size() - at < kChunkFrame) return damaged(at);
    const std::uint32_t length = number_at(png.substr(at));
    if (length > png.size() - at - kChunkFrame) return damaged(at);
    chunks.push_back({png.substr(at + 4, 4), png.substr(at + 8, length)});
    at += kChunkFrame + length;
  }
  if (chunks.empty() || chunks.front().type != "IHDR" || chunks.front().data.size() != 13) return damaged(0);
  return chunks;
}

/// fcTL: the whole picture, shown so long, over what was there.
std::string frame_control(std::uint32_t sequence, std::string_view header, double frame_s) {
  constexpr std::uint32_t kPerSecond = 1000;
  const auto delay = static_cast<std::uint32_t>(std::clamp(std::lround(frame_s * kPerSecond), 1L, 65535L));
  return big_endian(sequence) + std::string(header.substr(0, 8)) + big_endian(0) + big_endian(0) +
         big_endian(delay, 2) + big_endian(kPerSecond, 2) + std::string(2, '\0');
}

}  // namespace

Result<void> write_movie(std::span<const std::filesystem::path> pictures, double frame_s,
                         const std::filesystem::path& file) {
  if (pictures.empty()) return fail(ErrorCode::usage, "a movie needs pictures", {file.string()});
  if (file.extension() != ".png") return fail(ErrorCode::usage, "expected a name that ends in .png", {file.string()});
  std::string movie(kSignature);
  std::string header;
  std::uint32_t sequence = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto bytes = read_file(pictures[i]);
    if (!bytes) return pass_on(bytes);
    const auto chunks = chunks_of(*bytes, pictures[i].string());
    if (!chunks) return pass_on(chunks);
    const std::string_view own = chunks->front().data;
    if (i == 0) {
      header = std::string(own);
      add_chunk(movie, "IHDR", header);
      add_chunk(movie, "acTL", big_endian(static_cast<std::uint32_t>(pictures.size())) + big_endian(0));
    }
    if (own != header)
      return fail(ErrorCode::mismatch, "another size than the pictures before", {pictures[i].string()});
    add_chunk(movie, "fcTL", frame_control(sequence++, header, frame_s));
    for (const Chunk& chunk : *chunks) {
      if (chunk.type != "IDAT") continue;
      // The first picture is a plain one, for programs that know nothing of movies.
      i == 0 ? add_chunk(movie, "IDAT", chunk.data)
             : add_chunk(movie, "fdAT", big_endian(sequence++) + std::string(chunk.data));
    }
  }
  add_chunk(movie, "IEND", {});
  return write_file(file, movie);
}

}  // namespace sonar
