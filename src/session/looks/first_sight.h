// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "session/listening.h"
#include "session/open/workspace.h"

namespace sonar {

/// What a survey is first seen at: once the figures of schools are there, the ping in which the strongest whole school of
/// its first observation that has any is strongest, with that school selected. Only as long as nobody has gone to another
/// ping, or selected a school; of an observation that somebody has gone to, its own schools.
/// threads  the window's
class FirstSight {
 public:
  /// Outlives it.
  explicit FirstSight(Workspace& workspace);

 private:
  void look();
  [[nodiscard]] bool look_at(std::size_t observation);

  Workspace& workspace_;
  bool waiting_ = false;
  bool may_leave_ = false;                ///< the observation: nobody has gone to it, nor left it at an earlier time
  std::optional<std::size_t> opened_at_;  ///< the observation
  Listening listening_;
};

}  // namespace sonar
