// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"
#include "pipeline/follow.h"
#include "pipeline/live_status.h"

namespace sonar {

/// "12:35:19 obs-0001/3: 182 m off at 271 deg, 45 m deep; 61.12345 4.56789; course 120 deg, 0.8 m/s; 35 x 18 x 9 m, -52.3 dB"
[[nodiscard]] std::string school_line(const LiveSchool& school);
/// The same for programs: the columns of school_pings.csv, and of schools.csv how it moves.
[[nodiscard]] nlohmann::json school_json(const LiveSchool& school);
[[nodiscard]] nlohmann::json status_json(const LiveStatus& status);

}  // namespace sonar
