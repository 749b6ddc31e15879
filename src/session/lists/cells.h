// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/time.h"
#include "session/review/rows.h"
#include "view/units.h"

namespace sonar {

[[nodiscard]] Cell text_cell(std::string text);
[[nodiscard]] Cell count_cell(std::int64_t count);
/// NaN = unknown: an empty cell. decimals as Cell has them.
[[nodiscard]] Cell number_cell(double value, int decimals);
/// A number with its standard error behind it: "63.2 \u00B1 1.4". NaN = unknown: the cell as it is.
[[nodiscard]] Cell with_error(Cell cell, double se);
/// Three significant digits, for quantities that go over many powers of ten.
[[nodiscard]] Cell broad_cell(double value);
/// The same cell in the unit that a user reads, its standard error too; what is neither a length nor a speed stays.
/// column_unit  of the cell's own column, "m"
[[nodiscard]] Cell in_units(Cell cell, std::string_view column_unit, const Units& units);
/// "2026-11-21 19:57:26" UTC; 0 = unknown.
[[nodiscard]] Cell time_cell(TimeNs time);
/// "19:57:26" where the day is the same, for the second end of a span.
[[nodiscard]] std::string span_text(TimeNs first, TimeNs last);
/// Without year and seconds: "21 Nov 19:57 \u2013 20:10", or "21 Nov 23:57 \u2013 22 Nov 00:10".
[[nodiscard]] std::string span_brief(TimeNs first, TimeNs last);
[[nodiscard]] Cell latitude_cell(double latitude_deg);
[[nodiscard]] Cell longitude_cell(double longitude_deg);

}  // namespace sonar
