// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <sonar_explorer/recipe.h>

#include <filesystem>
#include <string>
#include <utility>

#include "arrays.h"
#include "bindings.h"

namespace py = pybind11;

namespace sonar_explorer::python {
namespace {

/// Its notes are warnings, at the line that reads it.
Recipe warned_of(Recipe recipe) {
  for (const std::string& note : recipe.notes()) {
    if (PyErr_WarnEx(PyExc_UserWarning, note.c_str(), 1) != 0) throw py::error_already_set();
  }
  return recipe;
}

}  // namespace

void bind_recipe(py::module_& m) {
  py::class_<Recipe>(m, "Recipe",
                     "Every parameter of every stage; a value that does not change. Recipe() is the preset 'default'.")
      .def(py::init<>(), "The preset 'default'.")
      .def_static(
          "preset", &Recipe::preset, py::arg("name"),
          "The recipe of a preset: 'default', or 'paper', the article of 2007 to the letter. Raises Error: usage "
          "(no such preset).")
      .def_static(
          "from_json", [](const std::string& text) { return warned_of(Recipe::from_json(text)); }, py::arg("text"),
          "A recipe from JSON text as to_json() gives it, or part of it: what is absent keeps its default. Warns of "
          "parameters that are named as earlier versions did, see `notes`. Raises Error: format, newer_version, "
          "bad_parameter.")
      .def_static(
          "from_file", [](const std::filesystem::path& path) { return warned_of(Recipe::from_file(path)); },
          py::arg("path"),
          "A recipe from a JSON file, read as from_json() reads text. Raises Error: not_found, io, and those of "
          "from_json().")
      .def("to_json", &Recipe::to_json, "All parameters as JSON text, defaults filled in, keys sorted.")
      .def_property_readonly("hash", &Recipe::hash, "str: hexadecimal; equal recipes have equal hashes")
      .def_property_readonly(
          "notes", &Recipe::notes,
          "list of str, a line each: parameters that the text named as earlier versions did, or that have no effect "
          "any more")
      .def(
          "with_value",
          [](const Recipe& recipe, const std::string& name, const py::object& value) {
            return recipe.with(name, py::module_::import("json").attr("dumps")(value).cast<std::string>());
          },
          py::arg("name"), py::arg("value"),
          "A recipe that differs in one parameter: recipe.with_value('detect.tolerance_db', 8.5). Names, units and "
          "ranges: docs/parameters.md. Raises Error: bad_parameter (no such parameter, or out of its range), format "
          "(a value of a wrong type).")
      .def("__repr__", [](const Recipe& r) { return words_of("<Recipe, hash {}>", r.hash().substr(0, 8)); });
}

}  // namespace sonar_explorer::python
