// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/result.h"
#include "base/task_thread.h"
#include "pipeline/stages/engine.h"

namespace sonar {

using StagedPingPtr = std::shared_ptr<const StagedPing>;
/// Ping index -> all its stages, made when asked for; called from any thread.
using StagedPingSource = std::function<Result<StagedPingPtr>(std::int64_t ping_index)>;

/// The pings round the one that is looked at, made ahead in the background.
/// threads  all members may be called from any thread
class PingCache {
 public:
  /// pings  of the observation
  /// reach  pings to each side of the one looked at that are made ahead and kept; while none is, nothing is kept
  PingCache(StagedPingSource source, std::int64_t pings, std::int64_t reach);

  /// From the cache, else made now.
  [[nodiscard]] Result<StagedPingPtr> ping(std::int64_t ping_index);
  /// What can be had at once; null where it cannot.
  [[nodiscard]] StagedPingPtr held(std::int64_t ping_index) const;
  /// The ping that is looked at: it and its neighbours, nearest first, are made in the background. Latest wins.
  /// arrived  called in the background as soon as the ping itself can be had, or with why it cannot
  void look_at(std::int64_t ping_index, std::function<void(const Result<StagedPingPtr>&)> arrived = {});
  /// Nobody looks any more: what is kept is let go.
  void rest();
  /// Keeps the ping that was asked for last too, wherever it lies: one that nobody looks at serves many calls.
  void keep_last();
  void wait() { background_.wait(); }

 private:
  void put(std::int64_t ping_index, const StagedPingPtr& ping);

  StagedPingSource source_;
  std::int64_t pings_;
  std::int64_t reach_;
  mutable std::mutex mutex_;
  std::optional<std::int64_t> centre_;  ///< empty = nobody looks
  std::map<std::int64_t, StagedPingPtr> kept_;
  bool keeps_last_ = false;
  std::pair<std::int64_t, StagedPingPtr> last_{-1, nullptr};
  TaskThread background_;  // the last member: it ends first
};

}  // namespace sonar
