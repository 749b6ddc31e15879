// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/time.h"

namespace sonar {

/// "2020-01-02 08:00:20.350 UTC", as people read it.
[[nodiscard]] std::string time_text(TimeNs time);

}  // namespace sonar
