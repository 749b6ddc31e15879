// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <functional>

#include "session/change_queue.h"

namespace sonar {

/// Drains the change queue once a turn of Qt's loop.
class QueuePump : public QObject {
 public:
  /// woken  called by whoever brought a change, after the loop was told; for tests that hold it there
  explicit QueuePump(std::function<void()> woken = {});
  [[nodiscard]] ChangeQueue& queue() { return queue_; }

 private:
  ChangeQueue queue_;
};

}  // namespace sonar
