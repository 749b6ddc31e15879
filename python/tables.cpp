// SPDX-License-Identifier: Apache-2.0
#include "tables.h"

#include <pybind11/stl.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "arrays.h"

namespace py = pybind11;

namespace sonar_explorer::python {
namespace {

py::object values_of(const Column& column) {
  return std::visit(
      [](const auto& values) -> py::object {
        if constexpr (std::is_same_v<std::decay_t<decltype(values)>, std::vector<std::string>>) {
          return py::cast(values);
        } else {
          return array_of(values);
        }
      },
      column.values);
}

/// datetime64[ns] of whole microseconds, which is what products keep. Whole numbers all the way: no double holds them.
py::object times_of(const Column& column) {
  constexpr std::int64_t kNotATime = std::numeric_limits<std::int64_t>::min();
  std::vector<std::int64_t> times_ns = column.times_ns;
  for (std::int64_t& time : times_ns) time = time == 0 ? kNotATime : time;
  const py::object exact = array_of(std::move(times_ns)).attr("view")("datetime64[ns]");
  return exact.attr("astype")("datetime64[us]").attr("astype")("datetime64[ns]");
}

/// `first_time` beside `first_time_utc`, `decided_time` beside `decided_utc`.
std::string name_of_times(const std::string& column) {
  std::string name = column.substr(0, column.size() - std::string_view("_utc").size());
  if (!name.ends_with("time")) name += "_time";
  return name;
}

py::dict attributes_of(const Column& column) {
  py::dict attributes;
  if (!column.unit.empty()) attributes["units"] = column.unit;
  if (!column.long_name.empty()) attributes["long_name"] = column.long_name;
  if (!column.standard_name.empty()) attributes["standard_name"] = column.standard_name;
  if (column.standard_name == "depth") attributes["positive"] = "down";
  if (!column.flags.empty()) {
    attributes[column.flags_are_bits ? "flag_masks" : "flag_values"] = array_of(column.flags);
    attributes["flag_meanings"] = column.flag_meanings;
  }
  return attributes;
}

}  // namespace

py::dict dict_of(const Table& table) {
  py::dict columns;
  for (const Column& column : table) columns[column.name.c_str()] = values_of(column);
  return columns;
}

py::object dataset_of(const Table& table, const char* dimension, const char* when) {
  py::dict variables;
  for (const Column& column : table) {
    variables[column.name.c_str()] = py::make_tuple(dimension, values_of(column), attributes_of(column));
    if (!column.name.ends_with("_utc")) continue;
    py::dict attributes = attributes_of(column);
    attributes["standard_name"] = "time";
    variables[name_of_times(column.name).c_str()] = py::make_tuple(dimension, times_of(column), attributes);
  }
  const py::object dataset = py::module_::import("xarray").attr("Dataset")(variables);
  return dataset.attr("set_coords")(std::vector<std::string>{when, "latitude", "longitude", "depth_m"});
}

}  // namespace sonar_explorer::python
