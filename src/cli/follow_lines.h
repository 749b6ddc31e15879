// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/live/live_schools.h"
#include "pipeline/live/live_status.h"

namespace sonar {

/// What school_line() tells, for programs: the columns of school_pings.csv, and of schools.csv how it moves.
[[nodiscard]] nlohmann::json school_json(const LiveSchool& school);
[[nodiscard]] nlohmann::json status_json(const LiveStatus& status);

}  // namespace sonar
