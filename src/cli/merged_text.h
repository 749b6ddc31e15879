// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/result.h"
#include "pipeline/tasks/merge.h"

namespace sonar {

/// What a merge made, on standard output: a text, or OUT/survey.json as it stands.
/// errors  io
[[nodiscard]] Result<void> print_merge(const MergeReport& report, const std::filesystem::path& out, bool json);

}  // namespace sonar
