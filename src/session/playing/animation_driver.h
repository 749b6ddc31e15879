// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "session/listeners.h"

namespace sonar {

/// What goes on by itself for a while: a window ticks at its own pace as long as something runs, and not at all otherwise.
/// threads  the window's
class AnimationDriver {
 public:
  /// now_s   a clock that never goes back
  /// return  whether there is more to do
  using Step = std::function<bool(double now_s)>;

  /// Runs until the step has nothing more to do; one of the same name is replaced.
  void run(const std::string& name, Step step);
  void stop(const std::string& name);
  [[nodiscard]] bool running() const { return !steps_.empty(); }
  void tick(double now_s);
  /// Called when running() has changed.
  [[nodiscard]] Listeners<>& changed() { return changed_; }

 private:
  struct Named {
    std::string name;
    Step step;
    int number = 0;
  };
  std::vector<Named> steps_;
  int last_ = 0;
  Listeners<> changed_;
};

}  // namespace sonar
