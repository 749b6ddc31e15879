// SPDX-License-Identifier: Apache-2.0
#include "gui/animation_timer.h"

#include <chrono>

namespace sonar {
namespace {

constexpr int kTick_ms = 15;

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

AnimationTimer::AnimationTimer(AnimationDriver& animations)
    : animations_(animations),
      listening_(animations.changed(), [this] { animations_.running() ? start(kTick_ms) : stop(); }) {
  callOnTimeout(this, [this] { animations_.tick(now_s()); });
  if (animations_.running()) start(kTick_ms);
}

}  // namespace sonar
