// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "view/maps/map_items.h"

namespace sonar {
namespace {

/// Visitor: the value of one column of a row.
class ColumnValue {
 public:
  explicit ColumnValue(std::size_t place) : left_(place) {}
  void operator()(std::string_view, std::string_view, const std::string&) { take(kUnknown); }
  void operator()(std::string_view, std::string_view, const std::int64_t& v) { take(static_cast<double>(v)); }
  void operator()(std::string_view, std::string_view, const double& v) { take(v); }
  void operator()(std::string_view, std::string_view, DegreesColumn v) { take(v.value); }
  void operator()(std::string_view, std::string_view, TimeColumn v) {
    take(v.value == 0 ? kUnknown : static_cast<double>(v.value) / 1e9);
  }
  [[nodiscard]] double value() const { return std::isfinite(value_) ? value_ : kUnknown; }

 private:
  void take(double value) {
    if (left_-- == 0) value_ = value;
  }
  std::size_t left_;
  double value_ = kUnknown;
};

template <class Row>
double value_of(Row& row, const ChartColumn& column) {
  ColumnValue value(column.place);
  columns(value, row);
  return value.value();
}

ChartRow row_of(const SchoolPingRow& row, std::size_t observation) {
  return {{observation, row.school_id}, row.ping_index, false};
}
ChartRow row_of(const SchoolRow& row, std::size_t observation) { return {{observation, row.school_id}, -1, false}; }

template <class Row>
void add_rows(ChartData& data, const std::vector<Row>& rows, std::size_t observation,
              const std::set<std::int64_t>& rejected, bool show_rejected) {
  Row row;  // the visitor wants one that could be changed
  for (const Row& one : rows) {
    ChartRow named = row_of(one, observation);
    named.rejected = rejected.contains(one.school_id);
    if (named.rejected && !show_rejected) continue;
    row = one;
    data.rows.push_back(named);
    data.x_values.push_back(value_of(row, data.x));
    if (data.y) data.y_values.push_back(value_of(row, *data.y));
  }
}

Result<ChartColumn> asked_column(ChartTable table, const std::string& name) {
  if (const ChartColumn* column = chart_column(table, name)) return *column;
  std::string there;
  for (const ChartColumn& one : chart_columns(table)) there += (there.empty() ? "" : ", ") + std::string(one.name);
  return fail(ErrorCode::usage, fmt::format("{} has no column {} of numbers or times; it has {}",
                                            kChartTableNames[static_cast<std::size_t>(table)], name, there));
}

}  // namespace

bool ChartData::known(std::size_t row) const {
  return !std::isnan(x_values[row]) && (!y || !std::isnan(y_values[row]));
}

std::size_t ChartData::known_rows() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) count += known(i) ? 1U : 0U;
  return count;
}

Result<ChartData> chart_data(std::span<const ObservationProduct> products, const ChartQuestion& asked) {
  ChartData data;
  data.table = asked.table;
  const auto x = asked_column(asked.table, asked.x);
  if (!x) return pass_on(x);
  data.x = shown_in(*x, asked.units);
  if (!asked.y.empty()) {
    const auto y = asked_column(asked.table, asked.y);
    if (!y) return pass_on(y);
    data.y = shown_in(*y, asked.units);
  }
  data.title = products.size() == 1 ? observation_title(products.front()) : survey_title(products);
  for (std::size_t i = 0; i < products.size(); ++i) {
    const ObservationProduct& product = products[i];
    data.observations.push_back(product.observation);
    std::set<std::int64_t> rejected;
    for (const SchoolRow& school : product.schools) {
      if (school.status == "rejected") rejected.insert(school.school_id);
    }
    if (asked.table == ChartTable::schools) {
      add_rows(data, product.schools, i, rejected, asked.rejected);
    } else {
      add_rows(data, product.school_pings, i, rejected, asked.rejected);
    }
  }
  return data;
}

}  // namespace sonar
