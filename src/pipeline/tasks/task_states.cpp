// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/task_states.h"

#include <fmt/format.h>

#include "io/product_file.h"
#include "pipeline/tasks/run.h"

namespace sonar {
namespace {

TaskState state_of(const PlanTask& task, const std::filesystem::path& out, const std::optional<TaskRecord>& record,
                   const AliveTest& alive) {
  const auto there = read_product_key(product_path(out, task.observation));
  // One whose masks were kept has a longer key.
  if (there && !task.key.empty() && there->input_hash.starts_with(task.key)) return TaskState::done;
  if (!record) return TaskState::waiting;
  if (!record->error.empty()) return TaskState::failed;
  return alive(*record).value_or(true) ? TaskState::running : TaskState::lost;
}

}  // namespace

std::vector<TaskStatus> task_states(const Plan& plan, const std::filesystem::path& out, const AliveTest& alive) {
  std::vector<TaskStatus> states;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    const PlanTask& task = plan.tasks[i];
    TaskStatus status{i, task.observation, TaskState::waiting, read_record(out, task.observation)};
    status.state = state_of(task, out, status.record, alive);
    states.push_back(std::move(status));
  }
  return states;
}

std::string index_list(const std::vector<std::size_t>& rising) {
  std::string text;
  for (std::size_t first = 0; first < rising.size();) {
    std::size_t last = first;
    while (last + 1 < rising.size() && rising[last + 1] == rising[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", rising[first]);
    if (last > first) text += fmt::format("-{}", rising[last]);
    first = last + 1;
  }
  return text;
}

}  // namespace sonar
