// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QCoreApplication>
#include <QThread>
#include <condition_variable>
#include <mutex>

namespace sonar {

/// Holds whoever brings news to the window while it is shut, so that a test may act half way through a job. The window's
/// own thread always passes.
class Gate {
 public:
  void shut() {
    const std::lock_guard lock(mutex_);
    open_ = false;
  }
  void open() {
    {
      const std::lock_guard lock(mutex_);
      open_ = true;
    }
    opened_.notify_all();
  }
  void pass() {
    if (QThread::currentThread() == QCoreApplication::instance()->thread()) return;
    std::unique_lock lock(mutex_);
    opened_.wait(lock, [this] { return open_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable opened_;
  bool open_ = true;
};

}  // namespace sonar
