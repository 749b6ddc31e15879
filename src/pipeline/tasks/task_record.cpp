// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/task_record.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <system_error>

#include "io/atomic_file.h"
#include "pipeline/recipe/json_file.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

fs::path path_of(const fs::path& out, const std::string& observation) {
  return out / "tasks" / (observation + ".json");
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets any
  return value != nullptr ? value : "";
}

std::string slurm_job() {
  const std::string array = variable("SLURM_ARRAY_JOB_ID");
  return array.empty() ? variable("SLURM_JOB_ID") : array + "_" + variable("SLURM_ARRAY_TASK_ID");
}

}  // namespace

TaskRecord record_of_this_process(TimeNs now) {
  return {host_name(), static_cast<std::int64_t>(::getpid()), slurm_job(), iso_time(now), ""};
}

Result<void> write_record(const fs::path& out, const std::string& observation, const TaskRecord& record) {
  if (auto own = require_own_folder(out / "tasks"); !own) return own;
  const nlohmann::json json = {{"observation", observation},    {"host", record.host},
                               {"process", record.process},     {"slurm_job", record.slurm_job},
                               {"since_utc", record.since_utc}, {"error", record.error}};
  return write_json_file(path_of(out, observation).string(), json);
}

void remove_record(const fs::path& out, const std::string& observation) {
  std::error_code absent;
  fs::remove(path_of(out, observation), absent);
}

std::optional<TaskRecord> read_record(const fs::path& out, const std::string& observation) {
  const auto json = read_json_file(path_of(out, observation).string());
  if (!json || !json->is_object()) return std::nullopt;
  const auto text = [&](const char* member) {
    const auto found = json->find(member);
    return found != json->end() && found->is_string() ? found->get<std::string>() : std::string{};
  };
  const auto process = json->find("process");
  const auto number = process != json->end() ? whole_number(*process, 1) : std::nullopt;
  return TaskRecord{text("host"), number.value_or(0), text("slurm_job"), text("since_utc"), text("error")};
}

std::optional<bool> is_alive(const TaskRecord& record) {
  if (record.host != host_name() || record.process <= 0) return std::nullopt;
  return ::kill(static_cast<pid_t>(record.process), 0) == 0 || errno == EPERM;
}

}  // namespace sonar
