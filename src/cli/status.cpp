// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/exit_codes.h"
#include "cli/named_path.h"
#include "cli/verb.h"
#include "io/external_command.h"
#include "pipeline/tasks/task_states.h"

namespace sonar {
namespace {

/// "123_4" of every array task that Slurm has at work; empty where Slurm cannot be asked.
std::optional<std::set<std::string>> slurm_jobs_at_work() {
  const auto said =
      run_command({"squeue", "--noheader", "--array", "--states=RUNNING,COMPLETING,CONFIGURING", "--format=%F_%K"});
  if (!said || said->exit_code != 0) return std::nullopt;
  std::set<std::string> jobs;
  std::string line;
  for (const char c : said->output) {
    if (c != '\n') {
      line += c;
    } else {
      jobs.insert(std::exchange(line, {}));
    }
  }
  return jobs;
}

/// By the process where it is of this host, else by Slurm, which is asked once.
AliveTest alive_test() {
  struct Asked {
    bool done = false;
    std::optional<std::set<std::string>> jobs;
  };
  const auto asked = std::make_shared<Asked>();
  return [asked](const TaskRecord& record) -> std::optional<bool> {
    if (const auto here = is_alive(record)) return here;
    if (record.slurm_job.empty()) return std::nullopt;
    if (!std::exchange(asked->done, true)) asked->jobs = slurm_jobs_at_work();
    if (!asked->jobs) return std::nullopt;
    return asked->jobs->contains(record.slurm_job);
  };
}

std::size_t count_of(const std::vector<TaskStatus>& tasks, TaskState state) {
  return static_cast<std::size_t>(
      std::count_if(tasks.begin(), tasks.end(), [&](const TaskStatus& task) { return task.state == state; }));
}

constexpr std::array kToldFirst = {TaskState::done, TaskState::running, TaskState::failed, TaskState::lost,
                                   TaskState::waiting};

std::string_view name_of(TaskState state) { return kTaskStateNames[static_cast<std::size_t>(state)]; }

void print_text(const std::vector<TaskStatus>& tasks) {
  std::string counts;
  for (const TaskState state : kToldFirst) {
    const std::size_t count = count_of(tasks, state);
    if (count > 0 || state == TaskState::done) {
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, name_of(state));
    }
  }
  fmt::print("{} tasks: {}\n", tasks.size(), counts);
  for (const TaskStatus& task : tasks) {
    if (task.state == TaskState::done || task.state == TaskState::waiting || !task.record) continue;
    const TaskRecord& who = *task.record;
    const std::string where =
        fmt::format("on {}{} since {}", printable(who.host),
                    who.slurm_job.empty() ? "" : ", job " + printable(who.slurm_job), printable(who.since_utc));
    const std::string why = task.state == TaskState::failed ? printable(who.error)
                            : task.state == TaskState::lost ? "began " + where + " and ended without a word"
                                                            : where;
    fmt::print("{} {} (task {}): {}\n", task.observation, name_of(task.state), task.task, why);
  }
}

void print_json(const std::vector<TaskStatus>& tasks) {
  nlohmann::json list = nlohmann::json::array();
  for (const TaskStatus& task : tasks) {
    nlohmann::json one = {{"task", task.task}, {"observation", task.observation}, {"state", name_of(task.state)}};
    if (task.record && task.state != TaskState::done) {
      one["host"] = task.record->host;
      one["process"] = task.record->process;
      one["slurm_job"] = task.record->slurm_job;
      one["since_utc"] = task.record->since_utc;
      one["error"] = task.record->error;
    }
    list.push_back(std::move(one));
  }
  nlohmann::json out = {{"tasks", std::move(list)}};
  for (const TaskState state : kToldFirst) out[std::string(name_of(state))] = count_of(tasks, state);
  fmt::print("{}\n", out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

int run_status(const std::string& out, bool json) {
  const auto plan = read_plan(std::filesystem::path(out) / "plan.json");
  if (!plan) return report(plan.error());
  const std::vector<TaskStatus> tasks = task_states(*plan, out, alive_test());
  json ? print_json(tasks) : print_text(tasks);
  return count_of(tasks, TaskState::failed) + count_of(tasks, TaskState::lost) == 0 ? kExitDone : kExitPartly;
}

}  // namespace

void add_status(CLI::App& app, VerbRunner& run) {
  const auto out = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  CLI::App* verb = app.add_subcommand("status", "Tell which tasks of a planned survey are done, running or failed");
  verb->add_option("OUT", *out, "Work folder with plan.json")->required()->check(named_path());
  verb->add_flag("--json", *json, "Print one JSON object");
  verb->callback([out, json, &run] { run = [out, json] { return run_status(*out, *json); }; });
}

}  // namespace sonar
