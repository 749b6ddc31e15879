// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>

#include "session/change_queue.h"

namespace sonar {

/// Drains the change queue once a turn of Qt's loop.
class QueuePump : public QObject {
 public:
  QueuePump();
  [[nodiscard]] ChangeQueue& queue() { return queue_; }

 private:
  ChangeQueue queue_;
};

}  // namespace sonar
