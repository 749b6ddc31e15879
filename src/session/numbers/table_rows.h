// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "session/lists/cells.h"
#include "session/review/rows.h"
#include "view/charts/chart_columns.h"

namespace sonar {

/// Visitor: the columns of a row as a list shows them.
class ColumnLister {
 public:
  void operator()(std::string_view n, std::string_view u, const std::string&) { add(n, u, false); }
  template <class Value>
  void operator()(std::string_view n, std::string_view u, const Value&) {
    add(n, u, !n.ends_with("_utc"));
  }
  [[nodiscard]] std::vector<ListColumn> take() { return std::move(columns_); }

 private:
  void add(std::string_view name, std::string_view unit, bool number) {
    ChartColumn column;
    column.name = name;
    column.unit = unit;
    columns_.push_back({column_words(column), unit_text(unit), std::string(name), number});
  }
  std::vector<ListColumn> columns_;
};

/// Visitor: one cell of a row.
class ListCell {
 public:
  explicit ListCell(std::size_t column) : column_(column) {}
  void operator()(std::string_view, std::string_view, const std::string& v) { put(text_cell(v)); }
  void operator()(std::string_view, std::string_view, const std::int64_t& v) { put(count_cell(v)); }
  void operator()(std::string_view, std::string_view, const double& v) { put(broad_cell(v)); }
  void operator()(std::string_view n, std::string_view, DegreesColumn v) {
    put(n.starts_with("lat") ? latitude_cell(v.value) : longitude_cell(v.value));
  }
  void operator()(std::string_view, std::string_view, TimeColumn v) { put(time_cell(v.value)); }
  [[nodiscard]] Cell take() { return std::move(cell_); }

 private:
  void put(Cell cell) {
    if (at_++ == column_) cell_ = std::move(cell);
  }
  std::size_t column_;
  std::size_t at_ = 0;
  Cell cell_;
};

/// Rows of a described table in a list, as its CSV has them, but for the units that are read.
/// threads  the window's
template <class Row>
class TableRows : public Rows {
 public:
  /// selected  what a click on a row does
  explicit TableRows(std::function<void(std::size_t)> selected = {}) : selected_(std::move(selected)) {
    ColumnLister lister;
    Row blank;
    sonar::columns(lister, blank);
    columns_ = as_told_ = lister.take();
  }
  /// Lengths and speeds, and their titles.
  void show_in(const Units& units) {
    units_ = units;
    for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].unit = shown_unit(as_told_[c].unit, units).name;
    changed().tell();
  }
  void set(std::vector<Row> rows) {
    rows_ = std::move(rows);
    changed().tell();
  }
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return columns_; }
  [[nodiscard]] std::size_t rows() const override { return rows_.size(); }
  [[nodiscard]] Cell cell(std::size_t row, std::size_t column) const override {
    ListCell cell(column);
    Row copy = rows_.at(row);
    sonar::columns(cell, copy);
    return in_units(cell.take(), as_told_[column].unit, units_);
  }
  void select(std::size_t row) override {
    if (selected_ && row < rows_.size()) selected_(row);
  }

 private:
  std::vector<ListColumn> columns_;
  std::vector<ListColumn> as_told_;  ///< in the units of the table
  Units units_;
  std::vector<Row> rows_;
  std::function<void(std::size_t)> selected_;
};

}  // namespace sonar
