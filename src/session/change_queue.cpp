// SPDX-License-Identifier: Apache-2.0
#include "session/change_queue.h"

#include <algorithm>
#include <utility>

namespace sonar {

void ChangeQueue::post(Change change) { add({{}, std::move(change)}); }

void ChangeQueue::post_latest(const std::string& name, Change change) { add({name, std::move(change)}); }

void ChangeQueue::add(Entry entry) {
  bool first = false;
  {
    const std::scoped_lock lock(mutex_);
    const auto waiting = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& other) {
      return !entry.name.empty() && other.name == entry.name;
    });
    if (waiting != entries_.end()) {
      std::swap(waiting->change, entry.change);
      return;  // what was replaced is let go behind the lock
    }
    first = entries_.empty();
    entries_.push_back(std::move(entry));
  }
  came_.notify_all();
  if (first && wake_) wake_();
}

std::size_t ChangeQueue::drain() {
  std::vector<Entry> turn;
  {
    const std::scoped_lock lock(mutex_);
    turn.swap(entries_);
  }
  for (const Entry& entry : turn) entry.change();
  return turn.size();
}

void ChangeQueue::wait() {
  std::unique_lock lock(mutex_);
  came_.wait(lock, [&] { return !entries_.empty(); });
}

}  // namespace sonar
