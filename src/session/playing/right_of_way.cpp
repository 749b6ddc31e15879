// SPDX-License-Identifier: Apache-2.0
#include "session/playing/right_of_way.h"

#include <condition_variable>
#include <mutex>

namespace sonar {

struct RightOfWay::State {
  std::mutex mutex;
  std::condition_variable free;
  int holders = 0;
  std::int64_t taken = 0;
  std::int64_t given = 0;
};

RightOfWay::RightOfWay() : state_(std::make_shared<State>()) {}

std::shared_ptr<const void> RightOfWay::take() {
  const std::scoped_lock lock(state_->mutex);
  ++state_->holders;
  ++state_->taken;
  return {nullptr, [state = state_](const void* /*nothing*/) {
            {
              const std::scoped_lock held(state->mutex);
              --state->holders;
            }
            state->free.notify_all();
          }};
}

bool RightOfWay::give_way(std::chrono::milliseconds most) {
  std::unique_lock lock(state_->mutex);
  if (state_->holders == 0) return false;
  ++state_->given;
  state_->free.wait_for(lock, most, [&] { return state_->holders == 0; });
  return true;
}

std::int64_t RightOfWay::taken() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->taken;
}

std::int64_t RightOfWay::given() const {
  const std::scoped_lock lock(state_->mutex);
  return state_->given;
}

void GivesWay::operator()() {
  const auto begun = std::chrono::steady_clock::now();
  if (works_until_ && begun < *works_until_) return;
  if (!way_.give_way(kMost)) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - begun >= kMost) works_until_ = now + kMost;
}

}  // namespace sonar
