// SPDX-License-Identifier: Apache-2.0
#include "view/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace sonar {
namespace {

constexpr double kFoot_m = 0.3048;
constexpr double kFathom_m = 6.0 * kFoot_m;
constexpr Unit kKnots{kKnot_mps, "kn"};
constexpr Unit kMetresPerSecond{1.0, "m/s"};

}  // namespace

Unit Units::length() const {
  switch (lengths) {
    case LengthUnit::feet:
      return {kFoot_m, "ft"};
    case LengthUnit::fathoms:
      return {kFathom_m, "fm"};
    case LengthUnit::metres:
      break;
  }
  return {1.0, "m"};
}

Unit Units::speed() const { return speeds == SpeedUnit::knots ? kKnots : kMetresPerSecond; }

Unit Units::ship_speed() const { return speeds == SpeedUnit::metres_per_second ? kMetresPerSecond : kKnots; }

std::string quantity_text(double si, int decimals, const Unit& unit) {
  return fmt::format("{:.{}f} {}", unit.of(si), decimals, unit.name);
}

double rounded(double si, const Unit& unit) {
  const double value = unit.of(si);
  if (unit.si == 1.0 || value == 0.0) return value;
  const double fine = std::pow(10.0, std::max(0.0, 2.0 - std::floor(std::log10(std::abs(value)))));
  return std::round(value * fine) / fine;
}

std::string round_text(double si, const Unit& unit) { return fmt::format("{:g} {}", rounded(si, unit), unit.name); }

std::string with_unit(std::string_view what, const Unit& unit) { return fmt::format("{} ({})", what, unit.name); }

double round_below(double most, const Unit& unit) {
  const double value = unit.of(most) * (1.0 + 1e-9);  // 4.999... is five
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0}) {
    if (step * power <= value) return step * power * unit.si;
  }
  return power * unit.si;
}

Unit shown_unit(std::string_view column_unit, const Units& units) {
  if (column_unit == "m") return units.length();
  const bool knots = column_unit == "kn";
  if (!knots && column_unit != "m/s" && column_unit != "m s-1" && column_unit != "m s\u207B\u00B9")
    return {1.0, column_unit};
  const Unit speed = knots ? units.ship_speed() : units.speed();
  const double own_mps = knots ? kKnot_mps : 1.0;
  return speed.si == own_mps ? Unit{1.0, column_unit} : Unit{speed.si / own_mps, speed.name};
}

}  // namespace sonar
