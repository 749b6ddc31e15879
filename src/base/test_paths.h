// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace sonar::test {

/// For tests: the root of the source tree. CTest tells it (SONAR_SOURCE); a test started by hand takes it from where it
/// was compiled, which holds unless the compiler was told to shorten paths.
inline std::filesystem::path source_tree() {
  const char* told = std::getenv("SONAR_SOURCE");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return told != nullptr ? std::filesystem::path(told)
                         : std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
}

/// The real recorded files: SONAR_DATA, else ../shared/data beside the tree. It need not exist.
inline std::filesystem::path recorded_data() {
  const char* told = std::getenv("SONAR_DATA");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return told != nullptr ? std::filesystem::path(told) : source_tree() / "../shared/data";
}

/// For tests: a path below the system's temporary folder that no other process has. Nothing is made there.
inline std::filesystem::path scratch_path(const std::string& name) {
  return std::filesystem::temp_directory_path() / ("sonar-" + std::to_string(::getpid()) + name);
}

}  // namespace sonar::test
