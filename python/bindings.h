// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

// What the module consists of, a file each.
namespace sonar_explorer::python {

void bind_recipe(pybind11::module_& m);
void bind_pings(pybind11::module_& m);
void bind_survey(pybind11::module_& m);
void bind_product(pybind11::module_& m);
void bind_schools(pybind11::module_& m);

/// Makes arguments that do not fit a TypeError of one line, of everything that is bound by now.
void refuse_in_one_line(const pybind11::module_& m);

}  // namespace sonar_explorer::python
