// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geo/frames.h"
#include "session/workspace.h"

namespace sonar {

/// Where on the globe the linked cursor is; empty without one, or without position or heading.
[[nodiscard]] std::optional<Geographic> cursor_place(const Workspace& workspace);

}  // namespace sonar
