// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "session/listening.h"
#include "session/open/workspace.h"

namespace sonar {

/// Keeps the slices on the selected school, wherever it was selected, and while pings play: a slice that misses it goes to
/// its middle, one that cuts it stays, so that a click in a slice does not move that slice; a plane is moved along its
/// normal, and laid anew only where a human chooses another kind of plane. Where the ping looked at has
/// none of the school, selecting it goes to the nearest one that has. Nothing follows while workspace.slices_locked.
/// threads  the window's
class SlicesFollow {
 public:
  /// Outlives the follower.
  explicit SlicesFollow(Workspace& workspace);

 private:
  void follow();
  void go_to_selected();
  /// Whether another ping is there than when this was asked last; the same one may come anew.
  [[nodiscard]] bool another_ping();

  Workspace& workspace_;
  std::pair<std::shared_ptr<const int>, std::int64_t> last_{nullptr, -1};  ///< observation and ping
  PlanePlace plane_;                                                       ///< as it last lay
  Listening listening_;
};

}  // namespace sonar
