// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "view/units.h"

namespace sonar {

/// Whose rows a chart shows.
enum class ChartTable : std::uint8_t { school_pings, schools };
inline constexpr std::array<std::string_view, 2> kChartTableNames{"school_pings", "schools"};

/// A column of a table that a chart can show: its values are numbers or times.
struct ChartColumn {
  std::string_view name;  ///< as the table has it: "depth_m"
  std::string_view unit;  ///< as the table has it: "m", "dB re 1 m-1", "1"; empty for times; "ft" where shown_in() says
  std::size_t place = 0;  ///< among all columns of the table
  bool time = false;      ///< UTC
  bool whole = false;     ///< numbers of things, without decimals
  bool degrees = false;   ///< angles and positions
  double unit_size = 1.0;  ///< of the table's unit in one of `unit`, where numbers are read in another: values stay

  /// Pings and times follow one another: what is drawn over them can be joined.
  [[nodiscard]] bool is_order() const { return time || name == "ping_index"; }
  /// Depths, which people draw downwards.
  [[nodiscard]] bool downwards() const { return name.starts_with("depth") || name == "bottom_depth_m"; }
  friend bool operator==(const ChartColumn&, const ChartColumn&) = default;
};

/// Of the table, in its order. Columns of words are none of them.
[[nodiscard]] std::span<const ChartColumn> chart_columns(ChartTable table);
/// The time of a school is that of its first ping: time_utc of schools stands for first_time_utc. Null where the table has
/// no such column of numbers or times.
[[nodiscard]] const ChartColumn* chart_column(ChartTable table, std::string_view name);

/// Names of the columns of both tables, each once.
[[nodiscard]] ChoiceNames chart_column_names();

/// The same column, read in a user's units: lengths and speeds are, areas, volumes and levels stay.
[[nodiscard]] ChartColumn shown_in(ChartColumn column, const Units& units);

/// "m", "m³", "dB re 1 m⁻¹", "degrees north"; empty for "1".
[[nodiscard]] std::string unit_text(std::string_view unit);
/// "sv_mean_db" -> "Sv mean": the unit stands elsewhere.
[[nodiscard]] std::string column_words(const ChartColumn& column);
/// "Sv mean (dB re 1 m⁻¹)"; with numbers in units of a power of ten, "backscatter (10⁻⁶ m²)".
[[nodiscard]] std::string axis_label(const ChartColumn& column, int power = 0);
/// A value of the column as a sentence has it: "-48.21 dB re 1 m⁻¹", "2020-01-04 08:00:50 UTC", "unknown".
[[nodiscard]] std::string column_text(const ChartColumn& column, double value);

}  // namespace sonar
