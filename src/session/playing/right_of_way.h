// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace sonar {

/// What a user waits for goes before what nobody waits for: whoever works for a user's eyes takes the right of way, and
/// what runs behind the window gives way between its steps. Copies are the same right.
/// threads  any
class RightOfWay {
 public:
  RightOfWay();
  /// Held until the last copy of what comes back is let go.
  [[nodiscard]] std::shared_ptr<const void> take();
  /// Returns when nobody has it, at the latest after `most`.
  /// out  whether somebody had it
  bool give_way(std::chrono::milliseconds most);
  /// How often it was taken, and how often somebody gave way, so far.
  [[nodiscard]] std::int64_t taken() const;
  [[nodiscard]] std::int64_t given() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

/// One job that gives way between its steps. It waits no longer than it has worked, once kMost was not enough: a user who
/// never rests slows it down and does not stop it.
class GivesWay {
 public:
  explicit GivesWay(RightOfWay way) : way_(std::move(way)) {}
  void operator()();

  static constexpr std::chrono::milliseconds kMost{250};

 private:
  RightOfWay way_;
  std::optional<std::chrono::steady_clock::time_point> works_until_;
};

}  // namespace sonar
