// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "session/listeners.h"
#include "session/recipes/parameters.h"

namespace sonar {

/// What somebody listens to; it stops when this goes.
class Listening {
 public:
  Listening() = default;
  template <class To, class Heard>
  Listening(To& listened, Heard heard) {
    to(listened, std::move(heard));
  }
  ~Listening() = default;
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  template <class... What>
  void to(Listeners<What...>& listeners, typename Listeners<What...>::Listener heard) {
    kept_.push_back(listeners.listen(std::move(heard)));
  }
  /// heard  of the new values, or of nothing but that there are some
  template <class P, class Heard>
  void to(Parameters<P>& parameters, Heard heard) {
    if constexpr (std::is_invocable_v<Heard, const P&>) {
      to(parameters.changed(), std::move(heard));
    } else {
      to(parameters.changed(), [heard = std::move(heard)](const P&) { heard(); });
    }
  }

 private:
  std::vector<std::shared_ptr<const void>> kept_;
};

}  // namespace sonar
