// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace sonar_explorer {

/// What could not be done: one line that names file, place and what was expected, as the command line prints it.
class Error : public std::runtime_error {
 public:
  /// kind  "not_found", "io", "no_space", "format", "newer_version", "older_version", "mismatch", "usage",
  ///       "bad_parameter", "unsupported", "cancelled"
  Error(const std::string& line, std::string kind) : std::runtime_error(line), kind_(std::move(kind)) {}
  [[nodiscard]] const std::string& kind() const { return kind_; }

 private:
  std::string kind_;
};

}  // namespace sonar_explorer
