// SPDX-License-Identifier: Apache-2.0
#include "publish/reports/report_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "base/number_text.h"

namespace sonar {
namespace {

/// Empty where the field is no plain number.
std::optional<double> number_in(std::string_view field) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size() ? std::optional(value) : std::nullopt;
}

std::string number_text(std::string_view column, std::string_view field, double value) {
  if (field.find_first_of(".eE") == std::string_view::npos) return std::string(field);
  const bool place = column.ends_with("latitude") || column.ends_with("longitude");
  return place ? fmt::format("{:.5f}", value) : fmt::format("{:.5g}", value);
}

}  // namespace

std::vector<std::size_t> columns_with_values(const CsvTable& table) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    if (std::ranges::any_of(table.records, [&](const CsvRecord& r) { return !r.fields[i].empty(); })) out.push_back(i);
  }
  return out;
}

ReportCell report_cell(std::string_view column, std::string_view field) {
  const auto number = number_in(field);
  if (!number) return {std::string(field), false};
  return {number_text(column, field, *number), true};
}

std::string rows_left_out(const CsvTable& table, std::size_t most) {
  if (table.records.size() <= most) return {};
  return fmt::format("The first {} of {} rows.", grouped(most), grouped(table.records.size()));
}

}  // namespace sonar
