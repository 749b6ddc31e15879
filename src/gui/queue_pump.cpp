// SPDX-License-Identifier: Apache-2.0
#include "gui/queue_pump.h"

#include <QMetaObject>
#include <utility>

namespace sonar {

QueuePump::QueuePump(std::function<void()> woken)
    : queue_([this, woken = std::move(woken)] {
        QMetaObject::invokeMethod(
            this, [this] { queue_.drain(); }, Qt::QueuedConnection);
        if (woken) woken();
      }) {}

}  // namespace sonar
