// SPDX-License-Identifier: Apache-2.0
#include "session/lists/cells.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "session/looks/place_text.h"

namespace sonar {
namespace {

constexpr std::size_t kDateLetters = 10;  // 2026-11-21
constexpr std::size_t kTimeLetters = 19;  // 2026-11-21T19:57:26

std::string date_and_time(TimeNs time) {
  std::string text = iso_time(time).substr(0, kTimeLetters);
  if (text.size() > kDateLetters) text[kDateLetters] = ' ';
  return text;
}

/// "21 Nov"
std::string day_and_month(const std::string& date) {
  constexpr std::array<const char*, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const auto two_digits = [&date](std::size_t at) { return (date[at] - '0') * 10 + date[at + 1] - '0'; };
  return fmt::format("{} {}", two_digits(8), kMonths.at(static_cast<std::size_t>(two_digits(5) - 1)));
}

Cell place_cell(std::string text, double deg) {
  if (std::isnan(deg)) return {};
  return {std::move(text), deg};
}

}  // namespace

Cell text_cell(std::string text) {
  if (text.empty()) return {};
  Cell cell;
  cell.key = text;
  cell.text = std::move(text);
  return cell;
}

Cell count_cell(std::int64_t count) { return {std::to_string(count), static_cast<double>(count)}; }

Cell number_cell(double value, int decimals) {
  if (std::isnan(value)) return {};
  return {decimals < 0 ? fmt::format("{:.3g}", value) : fmt::format("{:.{}f}", value, decimals), value, {}, decimals};
}

Cell with_error(Cell cell, double se) {
  if (!std::isfinite(se) || cell.text.empty()) return cell;
  cell.se = se;
  cell.brief = cell.text;
  cell.text += fmt::format(" \u00B1 {}", number_cell(se, cell.decimals).text);
  return cell;
}

Cell broad_cell(double value) { return number_cell(value, -1); }

Cell in_units(Cell cell, std::string_view column_unit, const Units& units) {
  const Unit unit = shown_unit(column_unit, units);
  const auto* value = std::get_if<double>(&cell.key);
  if (value == nullptr || unit.si == 1.0) return cell;
  return with_error(number_cell(unit.of(*value), cell.decimals), unit.of(cell.se));
}

Cell time_cell(TimeNs time) {
  if (time == 0) return {};
  return {date_and_time(time), static_cast<double>(time)};
}

std::string span_text(TimeNs first, TimeNs last) {
  const std::string begin = date_and_time(first);
  const std::string end = date_and_time(last);
  const bool same_day = begin.substr(0, kDateLetters) == end.substr(0, kDateLetters);
  return begin + " \u2013 " + (same_day ? end.substr(kDateLetters + 1) : end);
}

std::string span_brief(TimeNs first, TimeNs last) {
  const std::string begin = date_and_time(first);
  const std::string end = date_and_time(last);
  if (begin.size() != kTimeLetters || end.size() != kTimeLetters) return span_text(first, last);
  const auto minutes = [](const std::string& time) { return time.substr(kDateLetters + 1, 5); };
  const bool same_day = begin.substr(0, kDateLetters) == end.substr(0, kDateLetters);
  return fmt::format("{} {} \u2013 {}{}", day_and_month(begin), minutes(begin),
                     same_day ? std::string() : day_and_month(end) + " ", minutes(end));
}

Cell latitude_cell(double latitude_deg) { return place_cell(latitude_minutes_text(latitude_deg), latitude_deg); }

Cell longitude_cell(double longitude_deg) { return place_cell(longitude_minutes_text(longitude_deg), longitude_deg); }

}  // namespace sonar
