// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace sonar {

/// Hands out blocks of bytes and takes them back when their last owner lets go, so that a run of pings does not ask
/// the system for fresh pages each time. Blocks may outlive the pool.
/// threads  any
class BlockPool {
 public:
  /// kept_bytes  how much is kept for later at most
  explicit BlockPool(std::size_t kept_bytes = std::size_t{64} << 20);
  /// At least `size` bytes, contents undefined.
  [[nodiscard]] std::shared_ptr<std::byte[]> take(std::size_t size);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace sonar
