// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace sonar {

/// Those who want to hear of something; each is called in the order in which it came. One that is gone must not be called:
/// a listener and what it listens to live equally long, or the listener goes by remove().
/// threads  the window's
template <class... What>
class Listeners {
 public:
  using Listener = std::function<void(What...)>;

  /// out  what remove() wants
  int add(Listener listener) {
    listeners_.emplace_back(++last_, std::move(listener));
    return last_;
  }
  void remove(int id) {
    std::erase_if(listeners_, [&](const auto& one) { return one.first == id; });
  }
  void tell(What... what) const {
    const auto now = listeners_;  // a listener may add or remove others
    for (const auto& [id, listener] : now) listener(what...);
  }

 private:
  std::vector<std::pair<int, Listener>> listeners_;
  int last_ = 0;
};

}  // namespace sonar
