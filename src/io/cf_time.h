// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "base/time.h"

namespace sonar::cf {

/// What a CF unit of time, "days since 2009-01-01 00:00:00", means: the time of 0 and the length of 1.
struct TimeAxis {
  TimeNs origin = 0;
  double unit_s = 1.0;
};

/// Days, hours, minutes, seconds, milliseconds and microseconds since a date, with or without a time of day, in UTC.
/// Empty where it is none of these.
[[nodiscard]] std::optional<TimeAxis> time_axis(std::string_view units);

}  // namespace sonar::cf
