// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/task_record.h"

namespace sonar {

/// Where a task of a plan stands. lost: whoever worked on it is gone, and neither product nor reason is there.
enum class TaskState : std::uint8_t { waiting, running, done, failed, lost };
inline constexpr std::array<std::string_view, 5> kTaskStateNames{"waiting", "running", "done", "failed", "lost"};

struct TaskStatus {
  std::size_t task = 0;  ///< its number in the plan
  std::string observation;
  TaskState state = TaskState::waiting;
  std::optional<TaskRecord> record = {};  ///< of whoever works on it, or why it failed
};

/// Whether a task's record is of somebody still at work; empty = nobody can tell, and it is taken for so.
using AliveTest = std::function<std::optional<bool>(const TaskRecord& record)>;

/// Each task of a plan, in its order.
/// out  the plan's folder, with its products and records
[[nodiscard]] std::vector<TaskStatus> task_states(const Plan& plan, const std::filesystem::path& out,
                                                  const AliveTest& alive);

/// "0-3,7,9-11".
[[nodiscard]] std::string index_list(const std::vector<std::size_t>& rising);

}  // namespace sonar
