// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sonar {

/// Those who want to hear of something, each by a Listening; they are called in the order in which they came.
/// threads  the window's
template <class... What>
class Listeners {
 public:
  using Listener = std::function<void(What...)>;

  void tell(What... what) const {
    const auto now = listeners_;  // a listener may add others, or end some: those are not called any more
    for (const auto& one : now) {
      if (const auto listener = one.lock()) (*listener)(what...);
    }
  }

 private:
  friend class Listening;
  /// For as long as what comes back is kept, which may be longer than these are.
  [[nodiscard]] std::shared_ptr<const void> listen(Listener listener) {
    std::erase_if(listeners_, [](const auto& one) { return one.expired(); });
    auto kept = std::make_shared<const Listener>(std::move(listener));
    listeners_.push_back(kept);
    return kept;
  }

  std::vector<std::weak_ptr<const Listener>> listeners_;
};

}  // namespace sonar
