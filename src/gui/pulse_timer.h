// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTimer>

#include "session/pulse.h"

namespace sonar {

/// Ticks a pulse while something runs in it, and rests otherwise.
class PulseTimer : public QTimer {
 public:
  /// The pulse outlives the timer.
  explicit PulseTimer(Pulse& pulse);
  ~PulseTimer() override;

 private:
  Pulse& pulse_;
  int listening_;
};

}  // namespace sonar
