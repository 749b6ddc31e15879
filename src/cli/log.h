// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "pipeline/tasks/run_survey.h"

namespace sonar {

/// What is told on standard error beside errors: notes and progress, nothing of it, or each step too.
enum class LogLevel : std::uint8_t { quiet, normal, verbose };
void set_log_level(LogLevel level);
[[nodiscard]] LogLevel log_level();

// A line each on standard error; in colour on a terminal, unless the environment says NO_COLOR.
void print_error(std::string_view line);   ///< "sonarx: LINE"
void print_note(std::string_view line);    ///< "note LINE"; not when quiet
void print_detail(std::string_view line);  ///< only when verbose
/// Each kind where it belongs: results on standard output, the others as above.
void print_line(const RunLine& line);

}  // namespace sonar
