// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace sonar {

/// What another program said and how it ended.
struct CommandAnswer {
  int exit_code = 0;
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// Runs a program of the user's PATH without a shell, and waits for it.
/// words   the program and its arguments
/// errors  not_found: there is no such program; io
[[nodiscard]] Result<CommandAnswer> run_command(const std::vector<std::string>& words);

/// One word of a shell's line, whatever it holds.
[[nodiscard]] std::string shell_word(const std::string& text);

}  // namespace sonar
