// SPDX-License-Identifier: Apache-2.0
#include "io/sealed_file.h"

#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "io/atomic_file.h"

namespace sonar {
namespace {

constexpr std::string_view kMagic = "SONARBLK";
constexpr std::uint64_t kVersion = 1;
constexpr std::uint64_t kMostBlocks = 64;
/// version, number of blocks, hash of the key; then size and hash of each block; then the hash of all that.
constexpr std::size_t kHead = kMagic.size() + 4 * sizeof(std::uint64_t);
constexpr std::size_t kBlockHead = 3 * sizeof(std::uint64_t);  ///< size and hash
constexpr std::size_t kHash = 2 * sizeof(std::uint64_t);

void put(std::string& out, std::uint64_t value) {
  std::array<char, sizeof(value)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(value));
  out.append(bytes.data(), bytes.size());
}

void put(std::string& out, const Hash128& hash) {
  put(out, hash.high);
  put(out, hash.low);
}

/// Numbers one after another; the bytes are there.
class Numbers {
 public:
  explicit Numbers(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::uint64_t next() {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes_.data(), sizeof(value));
    bytes_ = bytes_.subspan(sizeof(value));
    return value;
  }
  Hash128 next_hash() {
    const std::uint64_t high = next();
    return {high, next()};
  }

 private:
  std::span<const std::byte> bytes_;
};

std::optional<std::vector<std::byte>> bytes_at(const ByteSource& source, std::uint64_t offset, std::size_t size) {
  std::vector<std::byte> bytes(size);
  const auto got = source.read(offset, bytes);
  if (!got || *got != size) return std::nullopt;
  return bytes;
}

}  // namespace

std::optional<SealedFile> SealedFile::open(const std::filesystem::path& path, std::string_view key) {
  const auto source = open_file(path);
  if (!source) return std::nullopt;
  const auto size = (*source)->size();
  const auto head = bytes_at(**source, 0, kHead);
  if (!size || !head || std::memcmp(head->data(), kMagic.data(), kMagic.size()) != 0) return std::nullopt;
  Numbers numbers{std::span(*head).subspan(kMagic.size())};
  const std::uint64_t version = numbers.next();
  const std::uint64_t count = numbers.next();
  if (version != kVersion || count > kMostBlocks || numbers.next_hash() != hash_text(key)) return std::nullopt;
  const std::size_t sealed = kHead + static_cast<std::size_t>(count) * kBlockHead;
  const auto list = bytes_at(**source, 0, sealed + kHash);
  if (!list || Numbers(std::span(*list).subspan(sealed)).next_hash() != hash_bytes(std::span(*list).first(sealed))) {
    return std::nullopt;
  }
  SealedFile file;
  file.source_ = *source;
  std::uint64_t offset = sealed + kHash;
  Numbers blocks{std::span(*list).subspan(kHead)};
  for (std::uint64_t i = 0; i < count; ++i) {
    Block block;
    block.offset = offset;
    block.size = blocks.next();
    block.hash = blocks.next_hash();
    if (block.size > *size - offset) return std::nullopt;
    offset += block.size;
    file.blocks_.push_back(block);
  }
  return offset == *size ? std::optional(std::move(file)) : std::nullopt;
}

std::optional<std::vector<std::byte>> SealedFile::block(std::size_t index) const {
  if (index >= blocks_.size()) return std::nullopt;
  const Block& block = blocks_[index];
  auto bytes = bytes_at(*source_, block.offset, static_cast<std::size_t>(block.size));
  if (!bytes || hash_bytes(*bytes) != block.hash) return std::nullopt;
  return bytes;
}

void SealedFile::store(const std::filesystem::path& path, std::string_view key,
                       std::span<const std::vector<std::byte>> blocks, Beside beside) {
  if (blocks.size() > kMostBlocks) return;
  std::string out(kMagic);
  put(out, kVersion);
  put(out, blocks.size());
  put(out, hash_text(key));
  for (const auto& block : blocks) {
    put(out, block.size());
    put(out, hash_bytes(block));
  }
  put(out, hash_bytes(std::as_bytes(std::span(out))));
  for (const auto& block : blocks) out.append(reinterpret_cast<const char*>(block.data()), block.size());
  (void)write_file(path, out, beside);
}

}  // namespace sonar
