// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <sonar_explorer/product.h>

namespace sonar_explorer::python {

/// Columns by name: arrays of numbers, lists of texts.
[[nodiscard]] pybind11::dict dict_of(const Table& table);
/// xarray.Dataset with the names, coordinates and attributes that the table has in a product's netCDF, and the same times.
/// dimension  of its rows
/// when       the coordinate of time
[[nodiscard]] pybind11::object dataset_of(const Table& table, const char* dimension, const char* when);

}  // namespace sonar_explorer::python
