// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "base/time.h"

namespace sonar {

/// Who works on a task, or why it failed: OUT/tasks/obs-0001.json, written as the task begins, gone once its product is there.
struct TaskRecord {
  std::string host;
  std::int64_t process = 0;
  std::string slurm_job;  ///< "123_4" of a job array; empty = by hand
  std::string since_utc;  ///< ISO 8601
  std::string error;      ///< one line; empty = it is at work, or was when its host went
};

/// The record of this process, at work on a task since now.
[[nodiscard]] TaskRecord record_of_this_process(TimeNs now);
/// errors  io, no_space
[[nodiscard]] Result<void> write_record(const std::filesystem::path& out, const std::string& observation,
                                        const TaskRecord& record);
void remove_record(const std::filesystem::path& out, const std::string& observation);
/// Empty where there is none, or none that can be read.
[[nodiscard]] std::optional<TaskRecord> read_record(const std::filesystem::path& out, const std::string& observation);
/// Whether the record's process lives; empty where it cannot be told from here.
[[nodiscard]] std::optional<bool> is_alive(const TaskRecord& record);

}  // namespace sonar
