// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"

namespace sonar {

/// Where a program lies in the user's PATH; empty where there is none. The folder that one is in counts only where PATH names
/// it in full.
[[nodiscard]] std::optional<std::filesystem::path> program_in_path(std::string_view name);

/// Another program that reads from us through its standard input, started without a shell. What it prints goes nowhere;
/// of what it complains about the last line is kept. It is killed with this object unless end() was called. Move-only.
/// threads  used by one thread
class FedCommand {
 public:
  /// words   the program, with its folder, and its arguments
  /// errors  not_found: there is no such program; io
  [[nodiscard]] static Result<FedCommand> start(const std::vector<std::string>& words);
  FedCommand(FedCommand&& other) noexcept;
  FedCommand& operator=(FedCommand&&) = delete;
  FedCommand(const FedCommand&) = delete;
  FedCommand& operator=(const FedCommand&) = delete;
  ~FedCommand();

  /// Waits until the program has taken all of it.
  /// stop    asked ten times a second
  /// errors  cancelled; io: the program ended before, with what it complained about
  [[nodiscard]] Result<void> feed(std::string_view bytes, const std::function<bool()>& stop);
  /// There is no more: waits until the program has done its work.
  /// errors  cancelled; io: it failed, with what it complained about last
  [[nodiscard]] Result<void> end(const std::function<bool()>& stop);

 private:
  FedCommand(std::string name, pid_t pid, int input, int errors)
      : name_(std::move(name)), pid_(pid), input_(input), errors_(errors) {}
  void read_complaints();
  /// Waits for the end of the program, which has none of its streams any more, or is to end for another reason.
  [[nodiscard]] int wait();
  [[nodiscard]] tl::unexpected<Error> failed(int status);

  std::string name_;
  pid_t pid_ = -1;
  int input_ = -1;
  int errors_ = -1;
  std::string complaints_;
};

}  // namespace sonar
