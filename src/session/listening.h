// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "session/listeners.h"
#include "session/parameters.h"

namespace sonar {

/// What a model listens to; it stops when this goes.
class Listening {
 public:
  Listening() = default;
  ~Listening() {
    for (const auto& stop : stops_) stop();
  }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  template <class Heard, class... What>
  void to(Listeners<What...>& listeners, Heard heard) {
    const int id = listeners.add(std::move(heard));
    stops_.push_back([&listeners, id] { listeners.remove(id); });
  }
  template <class P>
  void to(Parameters<P>& parameters, std::function<void()> heard) {
    parameters.on_change([alive = std::weak_ptr<bool>(alive_), heard = std::move(heard)](const P&) {
      if (!alive.expired()) heard();
    });
  }

 private:
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  std::vector<std::function<void()>> stops_;
};

}  // namespace sonar
