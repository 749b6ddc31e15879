// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/time.h"

namespace sonar {

/// What the ship does in a period: it surveys along a transect, or is off effort (a trawl, a turn, a break).
enum class EffortType : std::uint8_t { transect, off };
inline constexpr std::array<std::string_view, 2> kEffortTypeNames{"transect", "off"};
[[nodiscard]] constexpr std::string_view name(EffortType type) {
  return kEffortTypeNames[static_cast<std::size_t>(type)];
}

/// A period of a survey, as a person tells it: a line of a transects CSV. What is off effort is cut out of a transect.
struct Transect {
  std::string name;
  std::string stratum;
  EffortType type = EffortType::transect;
  TimeNs start_utc = 0;
  TimeNs stop_utc = 0;  ///< not before start_utc; a ping at it belongs to the transect that begins there, if one does
  [[nodiscard]] bool holds(TimeNs time) const { return start_utc <= time && time <= stop_utc; }
  friend bool operator==(const Transect&, const Transect&) = default;
};

}  // namespace sonar
