// SPDX-License-Identifier: Apache-2.0
#include "gui/queue_pump.h"

#include <QMetaObject>

namespace sonar {

QueuePump::QueuePump()
    : queue_([this] {
        QMetaObject::invokeMethod(
            this, [this] { queue_.drain(); }, Qt::QueuedConnection);
      }) {}

}  // namespace sonar
