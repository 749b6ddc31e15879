// SPDX-License-Identifier: Apache-2.0
#include "io/block_pool.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace sonar {
namespace {

// Blocks come in steps of this, so that pings of slightly different size share them.
constexpr std::size_t kStep = std::size_t{256} << 10;

struct Block {
  std::unique_ptr<std::byte[]> bytes;
  std::size_t size = 0;
};

}  // namespace

struct BlockPool::State {
  std::mutex mutex;
  std::vector<Block> kept;
  std::size_t kept_bytes = 0;
  std::size_t limit = 0;

  Block find(std::size_t size) {
    const std::scoped_lock lock(mutex);
    const auto it = std::find_if(kept.rbegin(), kept.rend(),
                                 [&](const Block& block) { return block.size >= size && block.size / 2 <= size; });
    if (it == kept.rend()) return {};
    Block found = std::move(*it);
    kept.erase(std::next(it).base());
    kept_bytes -= found.size;
    return found;
  }

  void give_back(Block block) {
    const std::scoped_lock lock(mutex);
    if (kept_bytes + block.size > limit) return;
    kept_bytes += block.size;
    kept.push_back(std::move(block));
  }
};

BlockPool::BlockPool(std::size_t kept_bytes) : state_(std::make_shared<State>()) { state_->limit = kept_bytes; }

std::shared_ptr<std::byte[]> BlockPool::take(std::size_t size) {
  const std::size_t rounded = std::max<std::size_t>(1, (size + kStep - 1) / kStep) * kStep;
  Block block = state_->find(rounded);
  if (!block.bytes) block = {std::make_unique_for_overwrite<std::byte[]>(rounded), rounded};
  const std::size_t block_size = block.size;
  std::byte* bytes = block.bytes.release();
  return {bytes, [weak = std::weak_ptr<State>(state_), block_size](std::byte* p) {
            Block returned{std::unique_ptr<std::byte[]>(p), block_size};
            if (const auto state = weak.lock()) state->give_back(std::move(returned));
          }};
}

}  // namespace sonar
