// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/listening.h"
#include "session/open/workspace.h"

namespace sonar {

/// What an observation is first seen at: once the figures of its schools are there, the ping in which its strongest whole
/// school is strongest, with that school selected. Only as long as nobody has gone to another ping, or selected a school.
/// threads  the window's
class FirstSight {
 public:
  /// Outlives it.
  explicit FirstSight(Workspace& workspace);

 private:
  void look();

  Workspace& workspace_;
  bool waiting_ = false;
  Listening listening_;
};

}  // namespace sonar
