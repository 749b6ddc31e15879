// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "base/result.h"

namespace sonar {

/// A copy of this process that does one thing, talks with us over a stream, and may break or hang without harm. It is
/// gone with this object. Move-only.
/// threads  made by any that is not inside_library(); the caller holds the locks that the body needs free in no other
///          thread. Used by one thread.
class ChildProcess {
 public:
  /// body   runs in the child with its end of the stream; the child ends when it returns
  /// named  stands in messages
  /// errors io: no child process could be made
  static Result<ChildProcess> start(const std::function<void(int stream)>& body, const std::string& named);
  ChildProcess(ChildProcess&& other) noexcept
      : pid_(std::exchange(other.pid_, -1)), stream_(std::exchange(other.stream_, -1)) {}
  ChildProcess& operator=(ChildProcess&& other) noexcept {
    std::swap(pid_, other.pid_);
    std::swap(stream_, other.stream_);
    return *this;
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  enum class Heard { all, silence, gone };
  /// Waits for exactly so many bytes. silence: for so many seconds nothing came.
  [[nodiscard]] Heard hear(std::span<std::byte> bytes, unsigned seconds) const;
  /// False where the child is gone.
  [[nodiscard]] bool say(std::span<const std::byte> bytes) const;

 private:
  ChildProcess(pid_t pid, int stream) : pid_(pid), stream_(stream) {}
  pid_t pid_ = -1;
  int stream_ = -1;
};

/// For the child's body: all of it, or false.
[[nodiscard]] bool hear_all(int stream, std::span<std::byte> bytes);
[[nodiscard]] bool say_all(int stream, std::span<const std::byte> bytes);

}  // namespace sonar
