// SPDX-License-Identifier: Apache-2.0
#include "session/looks/place_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace sonar {
namespace {

std::string minutes_text(double deg, int degree_digits, char positive, char negative) {
  if (std::isnan(deg)) return {};
  // Rounded as a whole first, so that no minute is ever 60.
  const auto thousandths = static_cast<std::int64_t>(std::llround(std::abs(deg) * 60000.0));
  const double minutes = static_cast<double>(thousandths % 60000) / 1000.0;
  return fmt::format("{:0{}d}\u00B0{:06.3f}\u2032 {}", thousandths / 60000, degree_digits, minutes,
                     deg < 0 ? negative : positive);
}

}  // namespace

std::string latitude_minutes_text(double latitude_deg) { return minutes_text(latitude_deg, 2, 'N', 'S'); }

std::string longitude_minutes_text(double longitude_deg) { return minutes_text(longitude_deg, 3, 'E', 'W'); }

}  // namespace sonar
