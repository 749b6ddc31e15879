// SPDX-License-Identifier: Apache-2.0
#include "io/csv.h"

#include <fmt/format.h>

#include "model/later_columns.h"

namespace sonar {

bool is_formula(std::string_view text) { return text.find_first_of("=+-@\t\r") == 0; }

const std::string* CsvRowReader::field(std::string_view name) {
  if (!status_) return nullptr;
  const auto column = table_.require_column(name);
  if (!column) {
    status_ = pass_on(column);
    return nullptr;
  }
  return &record_.fields[*column];
}

void CsvRowReader::operator()(std::string_view name, std::string_view, std::string& v) {
  if (is_later_column(name) && !table_.column(name)) return;
  if (const std::string* text = field(name)) v = *text;
}

void CsvRowReader::operator()(std::string_view name, std::string_view, std::int64_t& v) {
  if (is_later_column(name) && !table_.column(name)) return;
  if (field(name) == nullptr) return;
  const auto value = table_.whole(record_, *table_.column(name));
  if (value) {
    v = *value;
  } else {
    status_ = pass_on(value);
  }
}

void CsvRowReader::operator()(std::string_view name, std::string_view, double& v) {
  if (is_later_column(name) && !table_.column(name)) return;
  if (field(name) == nullptr) return;
  const auto value = table_.number(record_, *table_.column(name));
  if (value) {
    v = *value;
  } else {
    status_ = pass_on(value);
  }
}

void CsvRowReader::operator()(std::string_view name, std::string_view, TimeColumn v) {
  const std::string* text = field(name);
  if (text == nullptr) return;
  v.value = 0;
  if (text->empty()) return;
  if (const auto time = time_from_iso(*text)) {
    v.value = *time;
  } else {
    refuse(name, *text, "a time like 2026-11-21T19:57:26.123Z");
  }
}

void CsvRowReader::refuse(std::string_view name, std::string_view found, std::string_view wanted) {
  status_ = fail(
      ErrorCode::format,
      fmt::format("line {}: column '{}' holds '{}'; {} was expected", record_.line, name, found.substr(0, 40), wanted),
      {.file = table_.file});
}

}  // namespace sonar
