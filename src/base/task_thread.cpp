// SPDX-License-Identifier: Apache-2.0
#include "base/task_thread.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace sonar {

struct TaskThread::State {
  struct Waiting {
    Job job;
    CancelToken token;
  };
  std::mutex mutex;
  std::condition_variable came;
  std::condition_variable idle;
  std::deque<Waiting> jobs;
  std::optional<CancelToken> running;
  bool ending = false;
  std::thread thread;

  /// Under the lock.
  void give_up_all() {
    for (const Waiting& waiting : jobs) waiting.token.cancel();
    if (running) running->cancel();
    jobs.clear();
  }

  void work() {
    std::unique_lock lock(mutex);
    while (true) {
      came.wait(lock, [&] { return ending || !jobs.empty(); });
      if (ending) return;
      Waiting next = std::move(jobs.front());
      jobs.pop_front();
      running = next.token;
      lock.unlock();
      next.job(next.token);
      next.job = {};  // what it holds is let go before anybody is told that it is done
      lock.lock();
      running.reset();
      if (jobs.empty()) idle.notify_all();
    }
  }
};

TaskThread::TaskThread() : state_(std::make_unique<State>()) {
  state_->thread = std::thread([state = state_.get()] { state->work(); });
}

TaskThread::~TaskThread() {
  {
    const std::scoped_lock lock(state_->mutex);
    state_->ending = true;
    state_->give_up_all();
  }
  state_->came.notify_all();
  state_->thread.join();
}

CancelToken TaskThread::post(Job job) {
  CancelToken token;
  {
    const std::scoped_lock lock(state_->mutex);
    state_->jobs.push_back({std::move(job), token});
  }
  state_->came.notify_one();
  return token;
}

CancelToken TaskThread::post_latest(Job job) {
  CancelToken token;
  {
    const std::scoped_lock lock(state_->mutex);
    state_->give_up_all();
    state_->jobs.push_back({std::move(job), token});
  }
  state_->came.notify_one();
  return token;
}

void TaskThread::wait() {
  std::unique_lock lock(state_->mutex);
  state_->idle.wait(lock, [&] { return state_->jobs.empty() && !state_->running; });
}

}  // namespace sonar
