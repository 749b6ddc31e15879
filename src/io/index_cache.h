// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "io/raw_index.h"
#include "model/index_cache.h"

namespace sonar {

/// The file's index, from the cache where it holds a right one, else by reading the file.
/// errors  not_found, io, cancelled
[[nodiscard]] Result<RawIndex> open_index(const std::filesystem::path& path, const IndexCache& cache, const Work& work);

/// Keeps the index of a whole file that was read otherwise, if it is still that large.
void keep_index(const std::filesystem::path& path, const IndexCache& cache, const RawIndex& index);

/// Lets the indexes of a survey's files hold equal settings once: 500 beams are 150 kB a file.
/// threads  any
class SharedSettings {
 public:
  void share(RawIndex& index);

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;
  std::mutex mutex_;
  std::map<Key, SharedValue<SounderConfig>> configs_;
  std::map<Key, SharedValue<TransmitSet>> transmits_;
};

/// The cache's byte form: magic, version, checksum, content.
[[nodiscard]] std::vector<std::byte> encode_index(const RawIndex& index);
/// Empty where the bytes are not what encode_index() of this version writes.
[[nodiscard]] std::optional<RawIndex> decode_index(std::span<const std::byte> bytes);

}  // namespace sonar
