// SPDX-License-Identifier: Apache-2.0
#include "api/running_work.h"

#include <mutex>
#include <set>

#include "sonar_explorer/stop.h"

namespace sonar_explorer {
namespace {

struct Running {
  std::mutex lock;
  std::set<sonar::Work*> works;
};

Running& running() {
  static Running all;
  return all;
}

}  // namespace

RunningWork::RunningWork(int threads) : work_(threads) {
  const std::scoped_lock lock(running().lock);
  running().works.insert(&work_);
}

RunningWork::~RunningWork() {
  const std::scoped_lock lock(running().lock);
  running().works.erase(&work_);
}

void stop_running() {
  const std::scoped_lock lock(running().lock);
  for (sonar::Work* work : running().works) work->cancel();
}

}  // namespace sonar_explorer
