// SPDX-License-Identifier: Apache-2.0
#include "session/open/ping_cache.h"

#include <cstdlib>
#include <utility>

#include "base/within_memory.h"

namespace sonar {

PingCache::PingCache(StagedPingSource source, std::int64_t pings, std::int64_t reach)
    : source_(std::move(source)), pings_(pings), reach_(reach) {}

Result<StagedPingPtr> PingCache::ping(std::int64_t ping_index) {
  if (auto ready = held(ping_index)) return ready;
  auto made = within_memory([&] { return source_(ping_index); });
  if (made) put(ping_index, *made);
  return made;
}

StagedPingPtr PingCache::held(std::int64_t ping_index) const {
  const std::scoped_lock lock(mutex_);
  if (last_.second && last_.first == ping_index) return last_.second;
  const auto found = kept_.find(ping_index);
  return found == kept_.end() ? nullptr : found->second;
}

void PingCache::put(std::int64_t ping_index, const StagedPingPtr& ping) {
  const std::scoped_lock lock(mutex_);
  if (keeps_last_) last_ = {ping_index, ping};
  if (centre_ && std::abs(ping_index - *centre_) <= reach_) kept_[ping_index] = ping;
}

void PingCache::rest() {
  (void)background_.post_latest([](const CancelToken&) {});  // what was to be made ahead is given up
  const std::scoped_lock lock(mutex_);
  centre_.reset();
  kept_.clear();
}

void PingCache::keep_last() {
  const std::scoped_lock lock(mutex_);
  keeps_last_ = true;
}

void PingCache::look_at(std::int64_t ping_index, std::function<void(const Result<StagedPingPtr>&)> arrived) {
  {
    const std::scoped_lock lock(mutex_);
    centre_ = ping_index;
    std::erase_if(kept_, [&](const auto& entry) { return std::abs(entry.first - ping_index) > reach_; });
  }
  background_.post_latest([this, ping_index, arrived = std::move(arrived)](const CancelToken& token) {
    const auto looked_at = ping(ping_index);
    if (!token.cancelled() && arrived) arrived(looked_at);
    for (std::int64_t away = 1; away <= reach_ && !token.cancelled(); ++away) {
      // Ahead first: most look at pings in their order.
      for (const std::int64_t i : {ping_index + away, ping_index - away}) {
        if (i >= 0 && i < pings_ && !token.cancelled()) (void)ping(i);
      }
    }
  });
}

}  // namespace sonar
