// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace sonar {

enum class LengthUnit : std::uint8_t { metres, feet, fathoms };
inline constexpr std::array<std::string_view, 3> kLengthUnitNames{"metres", "feet", "fathoms"};

/// usual: m/s, and knots where sailors read them (a ship's speed, the list of schools).
enum class SpeedUnit : std::uint8_t { usual, metres_per_second, knots };
inline constexpr std::array<std::string_view, 3> kSpeedUnitNames{"usual", "metres_per_second", "knots"};

/// A unit that numbers are shown in; what is shown is computed in SI all the same.
struct Unit {
  double si = 1.0;  ///< m or m/s in one of it
  std::string_view name{};
  [[nodiscard]] constexpr double of(double value_si) const { return value_si / si; }
};

/// What people read lengths and speeds in. Distances sailed stay in nautical miles, areas and volumes in m2 and m3.
struct Units {
  LengthUnit lengths = LengthUnit::metres;
  SpeedUnit speeds = SpeedUnit::usual;

  /// Foot of 0.3048 m, fathom of 6 feet (international yard and pound agreement, 1959).
  [[nodiscard]] Unit length() const;
  /// Knot of 1852 m an hour.
  [[nodiscard]] Unit speed() const;
  /// The same where knots are usual.
  [[nodiscard]] Unit ship_speed() const;
  friend bool operator==(const Units&, const Units&) = default;
};

/// "12.3 m", "40.4 ft": a length or a speed, of a unit above.
/// si  m or m/s
[[nodiscard]] std::string quantity_text(double si, int decimals, const Unit& unit);
/// In the unit: of what is round in SI alone three digits, 5 m are 16.4 ft and not 16.4042 ft, and all whole ones.
[[nodiscard]] double rounded(double si, const Unit& unit);
/// As many digits as a round number needs, "50 m"; rounded() before.
[[nodiscard]] std::string round_text(double si, const Unit& unit);
/// "depth (ft)", of an axis.
[[nodiscard]] std::string with_unit(std::string_view what, const Unit& unit);

/// The most that is 1, 2 or 5 times a power of ten of the unit and no more than `most` but for rounding, in SI: of a scale.
[[nodiscard]] double round_below(double most, const Unit& unit);

/// What a table's column is shown in, by the unit that it carries: "m", "m/s" (or "m s-1", as files and axes have it), "kn".
/// Every other one (areas, volumes, levels, nautical miles) stays: the same name, si = 1.
/// column_unit  outlives the result
/// result       its `si` is how many of the column's unit are in one of it
[[nodiscard]] Unit shown_unit(std::string_view column_unit, const Units& units);

}  // namespace sonar
