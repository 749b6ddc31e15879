// SPDX-License-Identifier: Apache-2.0
#include "gui/pulse_timer.h"

#include <chrono>

namespace sonar {
namespace {

constexpr int kTick_ms = 15;

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

PulseTimer::PulseTimer(Pulse& pulse)
    : pulse_(pulse), listening_(pulse.changed().add([this] { pulse_.running() ? start(kTick_ms) : stop(); })) {
  callOnTimeout(this, [this] { pulse_.tick(now_s()); });
  if (pulse_.running()) start(kTick_ms);
}

PulseTimer::~PulseTimer() { pulse_.changed().remove(listening_); }

}  // namespace sonar
