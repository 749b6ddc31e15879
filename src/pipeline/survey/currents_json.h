// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "base/result.h"
#include "model/current.h"

namespace sonar {

/// [{"time_utc": "2009-11-13T08:11:49.000Z", "latitude": 60.1, "longitude": 4.2, "profile": "12 0.103 -0.045; ..."}, ...]:
/// depth in m, velocity east and north in m/s, bin after bin; no place where it is unknown.
[[nodiscard]] nlohmann::json to_json(const CurrentProfiles& profiles);
/// errors  format: naming the profile
[[nodiscard]] Result<CurrentProfiles> currents_from_json(const nlohmann::json& json);

}  // namespace sonar
