// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace sonar {

/// Ends the program with one line on standard error: a contract between two pieces of our own code was broken.
[[noreturn]] void contract_broken(std::string_view condition, std::string_view file, int line);

}  // namespace sonar

/// Guards a contract between callers inside this program; never used on what a user or a file can bring.
#define SONAR_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::sonar::contract_broken(#condition, __FILE__, __LINE__))
