// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/work.h"

namespace sonar_explorer {

/// Work that stop_running() knows of while it lives.
class RunningWork {
 public:
  explicit RunningWork(int threads);
  ~RunningWork();
  RunningWork(const RunningWork&) = delete;
  RunningWork& operator=(const RunningWork&) = delete;
  [[nodiscard]] sonar::Work& work() { return work_; }

 private:
  sonar::Work work_;
};

}  // namespace sonar_explorer
