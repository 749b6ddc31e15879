// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "session/open/workspace.h"

namespace sonar {

/// The schools that views mark: all that are chosen, else the selected one.
[[nodiscard]] inline std::set<SchoolName> selection(const Workspace& workspace) {
  std::set<SchoolName> names = workspace.chosen_schools();
  if (names.empty() && workspace.school()) names.insert(*workspace.school());
  return names;
}

}  // namespace sonar
