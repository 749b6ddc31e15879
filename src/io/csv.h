// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/result.h"
#include "base/time.h"
#include "io/atomic_file.h"
#include "io/csv_table.h"
#include "model/school.h"

namespace sonar {

// Any struct with a `columns(Visitor&, Row&)` (model/school.h shows two) is written and read by these templates:
// one header row, shortest round-trip numbers, eight decimals for DegreesColumn, ISO 8601 for TimeColumn (millisecond),
// what is not finite and time 0 as an empty field.

/// Visitor that collects the header.
class CsvHeader {
 public:
  template <class Member>
  void operator()(std::string_view name, std::string_view /*unit*/, Member&& /*member*/) {
    if (!text_.empty()) text_ += ',';
    text_ += csv_field(name);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// How texts stand in a table.
enum class CsvTexts : std::uint8_t {
  as_they_are,
  no_formulas  ///< behind an apostrophe where a spreadsheet would take them for a formula
};

/// Whether a spreadsheet takes a text for a formula: it begins with =, +, -, @, a tab or a carriage return.
[[nodiscard]] bool is_formula(std::string_view text);

/// Visitor that collects one record.
class CsvLine {
 public:
  explicit CsvLine(CsvTexts texts = CsvTexts::as_they_are) : texts_(texts) {}
  void operator()(std::string_view, std::string_view, const std::string& v) {
    add(csv_field(texts_ == CsvTexts::no_formulas && is_formula(v) ? "'" + v : v));
  }
  void operator()(std::string_view, std::string_view, const std::int64_t& v) { add(std::to_string(v)); }
  void operator()(std::string_view, std::string_view, const double& v) { add(std::isfinite(v) ? shortest(v) : ""); }
  void operator()(std::string_view, std::string_view, TimeColumn v) { add(v.value == 0 ? "" : iso_time(v.value)); }
  void operator()(std::string_view, std::string_view, DegreesColumn v) {
    add(std::isfinite(v.value) ? degrees_text(v.value) : "");
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void add(std::string_view field) {
    if (!first_) text_ += ',';
    first_ = false;
    text_ += field;
  }
  CsvTexts texts_;
  std::string text_;
  bool first_ = true;
};

/// Visitor that fills one row from a record; columns may stand in any order, further ones are ignored.
class CsvRowReader {
 public:
  CsvRowReader(const CsvTable& table, const CsvRecord& record) : table_(table), record_(record) {}
  void operator()(std::string_view name, std::string_view, std::string& v);
  void operator()(std::string_view name, std::string_view, std::int64_t& v);
  void operator()(std::string_view name, std::string_view, double& v);
  void operator()(std::string_view name, std::string_view, TimeColumn v);
  void operator()(std::string_view name, std::string_view, DegreesColumn v) { (*this)(name, "", v.value); }
  /// The first thing that was wrong.
  [[nodiscard]] const Result<void>& status() const { return status_; }

 private:
  const std::string* field(std::string_view name);
  void refuse(std::string_view name, std::string_view found, std::string_view wanted);
  const CsvTable& table_;
  const CsvRecord& record_;
  Result<void> status_;
};

/// The whole file's text, lines ended by LF.
template <class Row>
[[nodiscard]] std::string csv_text(const std::vector<Row>& rows, CsvTexts texts = CsvTexts::as_they_are) {
  CsvHeader header;
  Row blank{};
  columns(header, blank);
  std::string text = header.text() + "\n";
  for (Row row : rows) {  // a copy: columns() takes a mutable row
    CsvLine line(texts);
    columns(line, row);
    text += line.text() + "\n";
  }
  return text;
}

/// errors  io, no_space
template <class Row>
Result<void> write_csv_rows(const std::filesystem::path& path, const std::vector<Row>& rows,
                            CsvTexts texts = CsvTexts::as_they_are) {
  return write_file(path, csv_text(rows, texts));
}

/// errors  format, naming file, line and column: a missing column, a field that is no number
template <class Row>
[[nodiscard]] Result<std::vector<Row>> csv_rows(const CsvTable& table) {
  std::vector<Row> rows;
  rows.reserve(table.records.size());
  for (const CsvRecord& record : table.records) {
    Row row{};
    CsvRowReader reader(table, record);
    columns(reader, row);
    if (!reader.status()) return pass_on(reader.status());
    rows.push_back(std::move(row));
  }
  return rows;
}

/// errors  also not_found, io
template <class Row>
[[nodiscard]] Result<std::vector<Row>> read_csv_rows(const std::filesystem::path& path) {
  const auto table = read_csv(path);
  if (!table) return pass_on(table);
  return csv_rows<Row>(*table);
}

}  // namespace sonar
