// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

#include "base/result.h"
#include "base/task_thread.h"
#include "pipeline/engine.h"

namespace sonar {

using StagedPingPtr = std::shared_ptr<const StagedPing>;
/// Ping index -> all its stages, made when asked for; called from any thread.
using StagedPingSource = std::function<Result<StagedPingPtr>(std::int64_t ping_index)>;

/// The pings round the one that is looked at, made ahead in the background.
/// threads  all members may be called from any thread
class PingCache {
 public:
  /// pings  of the observation
  /// reach  pings to each side that are made ahead and kept
  PingCache(StagedPingSource source, std::int64_t pings, std::int64_t reach);

  /// From the cache, else made now.
  [[nodiscard]] Result<StagedPingPtr> ping(std::int64_t ping_index);
  /// What can be had at once; null where it cannot.
  [[nodiscard]] StagedPingPtr held(std::int64_t ping_index) const;
  /// The ping that is looked at: it and its neighbours, nearest first, are made in the background. Latest wins.
  /// arrived  called in the background as soon as the ping itself can be had, or with why it cannot
  void look_at(std::int64_t ping_index, std::function<void(const Result<StagedPingPtr>&)> arrived = {});
  void wait() { background_.wait(); }

 private:
  void put(std::int64_t ping_index, const StagedPingPtr& ping);

  StagedPingSource source_;
  std::int64_t pings_;
  std::int64_t reach_;
  mutable std::mutex mutex_;
  std::int64_t centre_ = 0;
  std::map<std::int64_t, StagedPingPtr> kept_;
  TaskThread background_;  // the last member: it ends first
};

}  // namespace sonar
