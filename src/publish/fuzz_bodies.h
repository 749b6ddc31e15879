// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz target of kept echograms does; the plain tests replay its corpus through the same function.

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "base/check.h"
#include "io/fuzz_choices.h"
#include "io/sealed_file.h"
#include "publish/echograms/echogram_cache.h"

namespace sonar::fuzz {

/// An echogram out of the cache, of blocks of any bytes under right check sums, is none, or one whose levels belong together.
/// The first byte chooses how many blocks there are, the next two of each how long it is.
/// folder  to write into
inline void kept_echogram_file(std::span<const std::byte> bytes, const std::filesystem::path& folder) {
  Choices in(bytes);
  std::vector<std::vector<std::byte>> blocks(1 + in.byte() % 40);
  for (std::vector<std::byte>& block : blocks) {
    const std::size_t length = in.byte() + 256 * (in.byte() % 16);
    while (block.size() < length && !in.done()) block.push_back(static_cast<std::byte>(in.byte()));
  }
  const EchogramEntry entry{folder / "kept.echogram", "fuzz"};
  std::filesystem::remove(entry.path);
  SealedFile::store(entry.path, entry.key, blocks);
  for (const int level : {0, 1, 99}) {
    const auto echogram = kept_echogram(entry, level);
    if (!echogram) continue;
    SONAR_CHECK(echogram->levels() > 0 && echogram->pings_per_column() > 0);
    for (int i = 0; i < echogram->levels(); ++i) {
      const EchogramLevel& one = echogram->level(i);
      SONAR_CHECK(one.cells.size() == one.columns * static_cast<std::size_t>(one.bins));
    }
  }
}

}  // namespace sonar::fuzz
