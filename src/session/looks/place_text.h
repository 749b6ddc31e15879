// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace sonar {

/// Degrees and decimal minutes, as charts and logs have them: "60°23.456′ N", "005°19.001′ E".
[[nodiscard]] std::string latitude_minutes_text(double latitude_deg);
[[nodiscard]] std::string longitude_minutes_text(double longitude_deg);

}  // namespace sonar
