// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/time.h"
#include "model/school.h"

namespace sonar {

/// Rows turned into columns, for formats that keep a column in one piece. Time columns are ISO 8601 text.
struct TableColumn {
  std::string name;
  std::string unit;
  bool is_degrees = false;
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>> values;
};

/// Visitor that appends one row to a list of columns; the first row (or `define`) makes them.
class ColumnCollector {
 public:
  /// Starts the next row.
  void next_row() { at_ = 0; }
  void operator()(std::string_view n, std::string_view u, const std::string& v) { put(n, u, v, false); }
  void operator()(std::string_view n, std::string_view u, const std::int64_t& v) { put(n, u, v, false); }
  void operator()(std::string_view n, std::string_view u, const double& v) { put(n, u, v, false); }
  void operator()(std::string_view n, std::string_view u, DegreesColumn v) { put(n, u, v.value, true); }
  void operator()(std::string_view n, std::string_view u, TimeColumn v) {
    put(n, u, v.value == 0 ? std::string{} : iso_time(v.value), false);
  }
  /// Whether the values are kept, or only names, units and types.
  void keep_values(bool keep) { keep_ = keep; }
  [[nodiscard]] std::vector<TableColumn> take() { return std::move(columns_); }

 private:
  template <class T>
  void put(std::string_view name, std::string_view unit, const T& value, bool is_degrees) {
    if (at_ == columns_.size())
      columns_.push_back({std::string(name), std::string(unit), is_degrees, std::vector<T>{}});
    if (keep_) std::get<std::vector<T>>(columns_[at_].values).push_back(value);
    ++at_;
  }
  std::vector<TableColumn> columns_;
  std::size_t at_ = 0;
  bool keep_ = true;
};

/// All rows as columns; without rows the columns are there and empty.
template <class Row>
[[nodiscard]] std::vector<TableColumn> columns_of(const std::vector<Row>& rows) {
  ColumnCollector collector;
  Row blank{};
  collector.keep_values(false);
  columns(collector, blank);
  collector.keep_values(true);
  for (Row row : rows) {
    collector.next_row();
    columns(collector, row);
  }
  return collector.take();
}

}  // namespace sonar
