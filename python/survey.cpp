// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <sonar_explorer/survey.h>

#include <filesystem>
#include <variant>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "interruptible.h"

namespace py = pybind11;

namespace sonar_explorer::python {
namespace {

void bind_observation(py::module_& m) {
  py::class_<Observation>(m, "Observation", "A run of pings of one sounder on one beam grid. len() is their number.")
      .def_property_readonly("name", &Observation::name, "str, such as 'obs-0001'")
      .def_property_readonly("sounder", &Observation::sounder, "str, as the files name it")
      .def_property_readonly("files", &Observation::files, "list of str: names without folder")
      .def("__len__", &Observation::pings, "number of pings")
      .def_property_readonly("places", &Observation::places, "list of PingPlace: when and where each ping was made")
      .def_property_readonly("grid", &Observation::grid,
                             "Grid; None where the beams make no grid of fans and beams: such pings have no arrays")
      .def_property_readonly(
          "cell_volumes_m3",
          [](const Observation& o) {
            const auto grid = o.grid();
            return array_of(o.cell_volumes_m3(), grid ? shape_of(grid->shape()) : std::vector<py::ssize_t>{0});
          },
          "float64 [fan][beam][sample]: volume of each cell, m3; empty without a grid")
      .def(
          "ping", &Observation::ping, py::arg("index"), py::call_guard<py::gil_scoped_release>(),
          "Reads and processes one ping. index: from 0. Raises Error: usage (no such ping, or the beams make no grid), "
          "io, format.")
      .def("__repr__",
           [](const Observation& o) { return words_of("<Observation {}, {} pings>", o.name(), o.pings()); });
}

std::size_t pings_of(const Survey& survey) {
  std::size_t pings = 0;
  for (const Observation& one : survey.observations()) pings += one.pings();
  return pings;
}

/// A path, or several.
using Paths = std::variant<std::filesystem::path, std::vector<std::filesystem::path>>;

std::vector<std::filesystem::path> list_of(Paths paths) {
  if (auto* one = std::get_if<std::filesystem::path>(&paths)) return {std::move(*one)};
  return std::get<std::vector<std::filesystem::path>>(std::move(paths));
}

}  // namespace

void bind_survey(py::module_& m) {
  bind_observation(m);
  py::class_<Survey>(m, "Survey", "A survey's raw files, which are never written to.")
      .def_property_readonly("observations", &Survey::observations, "list of Observation, in time order")
      .def("observation", &Survey::observation, py::arg("name"), py::return_value_policy::copy,
           "An observation by its name, such as 'obs-0001'. Raises Error: usage (no such observation).")
      .def_property_readonly("notes", &Survey::notes, "list of str: what is wrong with the files, a line each")
      .def("__repr__", [](const Survey& s) {
        return words_of("<Survey, {} observations, {} pings>", s.observations().size(), pings_of(s));
      });
  m.def(
      "open_survey",
      [](Paths paths, const Recipe& recipe, int threads) {
        return interruptible(
            [list = list_of(std::move(paths)), &recipe, threads] { return Survey::open(list, recipe, threads); });
      },
      py::arg("paths"), py::arg_v("recipe", Recipe(), "Recipe()"), py::arg("threads") = 0,
      "Opens a survey. paths: a folder of raw files, a raw file, or a list of them, as str or os.PathLike. recipe: "
      "under "
      "which its pings are processed. threads: how many work at once; 0 = all of the machine's. Returns a Survey. "
      "Raises "
      "Error: not_found, io, bad_parameter, usage.");
}

}  // namespace sonar_explorer::python
