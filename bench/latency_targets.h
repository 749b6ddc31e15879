// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sonar::bench {

/// Times from an event to the picture that answers it, each beside the time it is to take. On a machine with other work
/// they are longer: a missed target fails the program only where it is asked to check.
class LatencyTargets {
 public:
  explicit LatencyTargets(bool check) : check_(check) {}

  /// A line with median, least and ninth of ten times, and whether the median is below the target.
  /// ms         at least one
  /// target_ms  empty = none was set
  [[nodiscard]] std::string line(const std::string& what, std::vector<double> ms, std::optional<double> target_ms);

  /// "all 7 targets met", or which were missed.
  [[nodiscard]] std::string verdict() const;
  /// Of the program: 1 where it checks and a target was missed.
  [[nodiscard]] int exit_code() const { return check_ && !missed_.empty() ? 1 : 0; }

 private:
  bool check_;
  int compared_ = 0;
  std::vector<std::string> missed_;
};

/// Arguments of a latency bench: "--check" anywhere, the others in order.
struct LatencyArguments {
  bool check = false;
  std::vector<std::string> others;
};
[[nodiscard]] LatencyArguments latency_arguments(int argc, char** argv);

}  // namespace sonar::bench
