// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace sonar {

/// The one way by which anything reaches the window: changes are posted from any thread and carried out together, once a
/// turn of the window's loop, by the thread that drains.
class ChangeQueue {
 public:
  using Change = std::function<void()>;

  /// wake  called once after a change came into an empty queue, by the thread that posted it and under no lock
  explicit ChangeQueue(std::function<void()> wake = {}) : wake_(std::move(wake)) {}

  void post(Change change);
  /// A change that replaces a waiting one of the same name, in its place: only the last progress need be drawn.
  void post_latest(const std::string& name, Change change);
  /// Carries out what has come so far, in order, under no lock; what comes meanwhile waits for the next turn.
  /// out  how many were carried out
  std::size_t drain();
  /// Waits until there is something to drain.
  void wait();

 private:
  struct Entry {
    std::string name;
    Change change;
  };
  void add(Entry entry);

  std::mutex mutex_;
  std::condition_variable came_;
  std::vector<Entry> entries_;
  std::function<void()> wake_;
};

}  // namespace sonar
