// SPDX-License-Identifier: Apache-2.0
#include "session/playing/animation_driver.h"

#include <utility>

namespace sonar {

void AnimationDriver::run(const std::string& name, Step step) {
  const bool before = running();
  std::erase_if(steps_, [&](const Named& one) { return one.name == name; });
  steps_.push_back({name, std::move(step), ++last_});
  if (!before) changed_.tell();
}

void AnimationDriver::stop(const std::string& name) {
  if (std::erase_if(steps_, [&](const Named& one) { return one.name == name; }) > 0 && !running()) changed_.tell();
}

void AnimationDriver::tick(double now_s) {
  const std::vector<Named> now = steps_;  // a step may run or stop others, itself too
  for (const Named& one : now) {
    if (one.step(now_s)) continue;
    const int number = one.number;
    if (std::erase_if(steps_, [&](const Named& other) { return other.number == number; }) > 0 && !running()) {
      changed_.tell();
    }
  }
}

}  // namespace sonar
