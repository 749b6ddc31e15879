// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "model/school.h"
#include "view/axes.h"
#include "view/maps/map_items.h"

namespace sonar {
namespace {

/// Visitor: lists the columns of numbers and times.
class ColumnLister {
 public:
  void operator()(std::string_view, std::string_view, const std::string&) { ++place_; }
  void operator()(std::string_view name, std::string_view unit, const std::int64_t&) {
    list_.push_back({.name = name, .unit = unit, .place = place_++, .whole = true});
  }
  void operator()(std::string_view name, std::string_view unit, const double&) {
    list_.push_back({.name = name, .unit = unit, .place = place_++, .degrees = unit == "degrees"});
  }
  void operator()(std::string_view name, std::string_view unit, DegreesColumn) {
    list_.push_back({.name = name, .unit = unit, .place = place_++, .degrees = true});
  }
  void operator()(std::string_view name, std::string_view, TimeColumn) {
    list_.push_back({.name = name, .unit = {}, .place = place_++, .time = true});
  }
  [[nodiscard]] std::vector<ChartColumn> take() { return std::move(list_); }

 private:
  std::vector<ChartColumn> list_;
  std::size_t place_ = 0;
};

template <class Row>
std::vector<ChartColumn> listed() {
  ColumnLister lister;
  Row blank;
  columns(lister, blank);
  return lister.take();
}

std::vector<std::string_view> names_of_both() {
  std::vector<std::string_view> names;
  for (const ChartTable table : {ChartTable::school_pings, ChartTable::schools}) {
    for (const ChartColumn& column : chart_columns(table)) {
      if (std::find(names.begin(), names.end(), column.name) == names.end()) names.push_back(column.name);
    }
  }
  return names;
}

std::string raised(std::string_view digits) {
  constexpr std::array<std::string_view, 10> kRaised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : digits) out += c == '-' ? "⁻" : std::string(kRaised[static_cast<std::size_t>(c - '0')]);
  return out;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

void replace_beginning(std::string& text, std::string_view from, std::string_view to) {
  if (text.starts_with(from)) text.replace(0, from.size(), to);
}

}  // namespace

std::span<const ChartColumn> chart_columns(ChartTable table) {
  static const std::vector<ChartColumn> pings = listed<SchoolPingRow>();
  static const std::vector<ChartColumn> schools = listed<SchoolRow>();
  return table == ChartTable::schools ? schools : pings;
}

const ChartColumn* chart_column(ChartTable table, std::string_view name) {
  if (table == ChartTable::schools && name == "time_utc") name = "first_time_utc";
  const auto all = chart_columns(table);
  const auto found = std::find_if(all.begin(), all.end(), [&](const ChartColumn& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

ChoiceNames chart_column_names() {
  static const std::vector<std::string_view> names = names_of_both();
  return names;
}

ChartColumn shown_in(ChartColumn column, const Units& units) {
  const Unit unit = shown_unit(column.unit, units);
  column.unit = unit.name;
  column.unit_size = unit.si;
  return column;
}

std::string unit_text(std::string_view unit) {
  if (unit == "1") return {};
  std::string out;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    // A power stands behind a letter: "m3", "m s-1".
    const bool behind_letter = i > 0 && std::isalpha(static_cast<unsigned char>(unit[i - 1])) != 0;
    std::size_t end = i + (unit[i] == '-' ? 1 : 0);
    while (end < unit.size() && is_digit(unit[end])) ++end;
    if (behind_letter && end > i && is_digit(unit[end - 1])) {
      out += raised(unit.substr(i, end - i));
      i = end - 1;
    } else {
      out += unit[i] == '_' ? ' ' : unit[i];
    }
  }
  return out;
}

std::string column_words(const ChartColumn& column) {
  constexpr std::array<std::string_view, 9> kUnits{"_m2_nmi2", "_utc", "_db", "_mps", "_m3", "_m2", "_m", "_deg", "_s"};
  std::string text(column.name);
  for (const std::string_view unit : kUnits) {
    if (!text.ends_with(unit)) continue;
    text.resize(text.size() - unit.size());
    break;
  }
  replace_beginning(text, "n_", "number of ");
  std::replace(text.begin(), text.end(), '_', ' ');
  replace_beginning(text, "sv ", "Sv ");
  if (text == "snr") return "SNR";
  if (text == "nasc") return "NASC";
  return text;
}

std::string axis_label(const ChartColumn& column, int power) {
  const std::string words = column_words(column);
  if (column.time) return words + " (UTC)";
  std::string unit = unit_text(column.unit);
  if (power != 0) unit = "10" + raised(std::to_string(power)) + (unit.empty() ? "" : " " + unit);
  return unit.empty() ? words : fmt::format("{} ({})", words, unit);
}

std::string column_text(const ChartColumn& column, double value) {
  if (!std::isfinite(value)) return "unknown";
  if (column.time) return clock_text(static_cast<TimeNs>(std::llround(value * 1e9)), true) + " UTC";
  if (column.whole) return tick_text(value, 0);
  const std::string unit = unit_text(column.unit);
  const bool position = column.unit.starts_with("degrees_");
  value /= column.unit_size;
  std::string number = position ? fmt::format("{:.5f}", value) : fmt::format("{:.4g}", value);
  if (number.starts_with('-')) number.replace(0, 1, "\u2212");
  return unit.empty() ? number : fmt::format("{} {}", number, unit);
}

}  // namespace sonar
