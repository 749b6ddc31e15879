// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace sonar {

/// A survey to be run.
struct NamedSurvey {
  std::vector<std::filesystem::path> paths;  ///< a folder of raw files, or raw files
  std::filesystem::path out;                 ///< that results of it are in already; empty = none was named
};

/// What a human names to be run: each folder is a survey of its own, as is each folder in one that has no raw files itself; files
/// are one together. A folder of a run's results stands for the survey that they are of.
/// errors  as read_plan()
[[nodiscard]] Result<std::vector<NamedSurvey>> named_surveys(const std::vector<std::filesystem::path>& paths);

/// "/data/leg-1", "/data/a.raw and 4 more".
[[nodiscard]] std::string text_of(const std::vector<std::filesystem::path>& paths);

/// A survey's raw files.
struct RawSize {
  std::size_t files = 0;
  std::uint64_t bytes = 0;
};
/// errors  as list_survey()
[[nodiscard]] Result<RawSize> raw_size(std::span<const std::filesystem::path> paths);

/// Whether one of two folders is, or lies in, the other; links followed.
[[nodiscard]] bool are_nested(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace sonar
