// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <sonar_explorer/product.h>

namespace sonar_explorer::python {

/// Columns by name: arrays of numbers, lists of texts.
[[nodiscard]] pybind11::dict dict_of(const Table& table);
/// xarray.Dataset: along one dimension, with units and long names.
[[nodiscard]] pybind11::object dataset_of(const Table& table, const char* dimension);

}  // namespace sonar_explorer::python
