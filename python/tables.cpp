// SPDX-License-Identifier: Apache-2.0
#include "tables.h"

#include <pybind11/stl.h>

#include <string>
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

py::dict attributes_of(const Column& column) {
  py::dict attributes;
  if (!column.unit.empty()) attributes["units"] = column.unit;
  if (!column.long_name.empty()) attributes["long_name"] = column.long_name;
  return attributes;
}

}  // namespace

py::dict dict_of(const Table& table) {
  py::dict columns;
  for (const Column& column : table) columns[column.name.c_str()] = values_of(column);
  return columns;
}

py::object dataset_of(const Table& table, const char* dimension) {
  py::dict variables;
  for (const Column& column : table) {
    variables[column.name.c_str()] = py::make_tuple(dimension, values_of(column), attributes_of(column));
  }
  return py::module_::import("xarray").attr("Dataset")(variables);
}

}  // namespace sonar_explorer::python
