// SPDX-License-Identifier: Apache-2.0
#include "io/product_seal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/hash.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLabel = "\nsonar-explorer XXH3-128 ";
constexpr std::size_t kSealSize = kLabel.size() + 32 + 1;
constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";

/// Hash of the first `size` bytes; empty when they cannot be read.
std::string hash_of_head(std::ifstream& in, std::uint64_t size) {
  Hasher hasher;
  std::vector<char> block(static_cast<std::size_t>(std::min<std::uint64_t>(size, 1 << 20)));
  while (size > 0) {
    const std::uint64_t part = size < block.size() ? size : block.size();
    if (!in.read(block.data(), static_cast<std::streamsize>(part))) return {};
    hasher.add(std::as_bytes(std::span(block.data(), static_cast<std::size_t>(part))));
    size -= part;
  }
  return to_hex(hasher.value());
}

}  // namespace

std::string seal_text(const std::string& hash) { return fmt::format("{}{}\n", kLabel, hash); }

Result<bool> check_seal(const fs::path& path, const std::string& named) {
  const Where where{.file = named};
  std::error_code error;
  if (!fs::exists(path, error)) return fail(ErrorCode::not_found, "no such file", where);
  if (!fs::is_regular_file(path, error)) return fail(ErrorCode::io, "is not a file", where);
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  if (error || !in) return fail(ErrorCode::io, "cannot be read", where);
  std::string head(kSignature.size(), '\0');
  if (!in.read(head.data(), static_cast<std::streamsize>(head.size())) || head != kSignature) {
    return fail(ErrorCode::format, "is no netCDF-4 file", {.file = named, .offset = 0});
  }
  if (size > kMostProductBytes) {
    return fail(ErrorCode::format, fmt::format("{} bytes; at most {} were expected", size, kMostProductBytes), where);
  }
  if (size < kSealSize) return fail(ErrorCode::format, "ends too early", where);
  const std::uint64_t body = size - kSealSize;
  std::string seal(kSealSize, '\0');
  in.seekg(static_cast<std::streamoff>(body));
  if (!in.read(seal.data(), static_cast<std::streamsize>(kSealSize))) {
    return fail(ErrorCode::io, "cannot be read", where);
  }
  if (!seal.starts_with(kLabel)) return false;
  in.seekg(0);
  if (hash_of_head(in, body) != seal.substr(kLabel.size(), 32)) {
    return fail(ErrorCode::format, "is damaged: its bytes are not those that were written", where);
  }
  return true;
}

}  // namespace sonar
