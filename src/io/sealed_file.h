// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "io/atomic_file.h"
#include "io/byte_source.h"

namespace sonar {

/// An entry of the user's cache: blocks of bytes under a key that says what they were made from. Each block carries its
/// hash and is read and checked alone.
class SealedFile {
 public:
  /// Empty where there is no such file, it was made under another key or by another version, or it is damaged or cut.
  [[nodiscard]] static std::optional<SealedFile> open(const std::filesystem::path& path, std::string_view key);

  [[nodiscard]] std::size_t blocks() const { return blocks_.size(); }
  /// Empty where there is no such block or its bytes are not those that were written.
  [[nodiscard]] std::optional<std::vector<std::byte>> block(std::size_t index) const;

  /// Writes whole or not at all. Failure is no error: what is not kept is made again.
  static void store(const std::filesystem::path& path, std::string_view key,
                    std::span<const std::vector<std::byte>> blocks, Beside beside = Beside::users_cache);

 private:
  struct Block {
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    Hash128 hash;
  };
  SealedFile() = default;

  std::shared_ptr<const ByteSource> source_;
  std::vector<Block> blocks_;
};

}  // namespace sonar
