// SPDX-License-Identifier: Apache-2.0
#include <sonar_explorer/product.h>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>

#include "arrays.h"
#include "bindings.h"
#include "tables.h"

namespace py = pybind11;

namespace sonar_explorer::python {
namespace {

void bind_masks(py::module_& m) {
  py::class_<MaskRun>(m, "MaskRun", "Neighbouring samples of one beam.")
      .def(py::init([](int fan, int beam, int first_sample, int count) {
             return MaskRun{fan, beam, first_sample, count};
           }),
           py::arg("fan"), py::arg("beam"), py::arg("first_sample"), py::arg("count"), "A run; all but `count` from 0.")
      .def_readwrite("fan", &MaskRun::fan, "from 0, the deepest")
      .def_readwrite("beam", &MaskRun::beam, "from 0, as in the arrays")
      .def_readwrite("first_sample", &MaskRun::first_sample, "from 0, the nearest")
      .def_readwrite("count", &MaskRun::count, "number of samples")
      .def("__repr__", [](const MaskRun& r) {
        return words_of("MaskRun(fan={}, beam={}, first_sample={}, count={})", r.fan, r.beam, r.first_sample, r.count);
      });
  py::class_<Mask>(m, "Mask", "A school's voxels in one ping.")
      .def(py::init<>(), "A mask without voxels.")
      .def_readwrite("school_id", &Mask::school_id, "number of the school in its observation, from 1")
      .def_readwrite("ping_index", &Mask::ping_index, "number of the ping in its observation, from 0")
      .def_readwrite("runs", &Mask::runs, "list of MaskRun, sorted by fan, beam and sample, without overlap; a copy")
      .def_readwrite("confidence", &Mask::confidence,
                     "list of int: of each voxel in the order of the runs, 1 to 255 for 255 f; a copy")
      .def("__repr__", [](const Mask& one) {
        return words_of("<Mask of school {} in ping {}, {} voxels>", one.school_id, one.ping_index,
                        one.confidence.size());
      });
}

}  // namespace

void bind_product(py::module_& m) {
  bind_masks(m);
  py::class_<Product>(m, "Product", "What was found in an observation: schools, their masks and figures.")
      .def_property_readonly("observation", &Product::observation, "str: name of its observation")
      .def_property_readonly("recipe_json", &Product::recipe_json, "str: the recipe that it was made with")
      .def_property_readonly(
          "schools", [](const Product& p) { return dict_of(p.schools()); },
          "dict: columns of schools.csv by name, arrays of numbers and lists of str. Units: docs/interfaces.md, or "
          "schools_dataset().")
      .def_property_readonly(
          "school_pings", [](const Product& p) { return dict_of(p.school_pings()); },
          "dict: columns of school_pings.csv by name, arrays of numbers and lists of str. Units: docs/interfaces.md, "
          "or "
          "school_pings_dataset().")
      .def_property_readonly(
          "rejected", [](const Product& p) { return dict_of(p.rejected()); },
          "dict: echoes that were judged not to be schools, columns of the product's group /rejected by name, arrays "
          "of "
          "numbers and lists of str")
      .def(
          "schools_dataset", [](const Product& p) { return dataset_of(p.schools(), "school", "first_time"); },
          "xarray.Dataset [school] of the schools, named and described as in the product's netCDF: units, flags, "
          "coordinates first_time, latitude, longitude and depth_m. Times are datetime64[ns], equal to those of "
          "/pings. "
          "Raises ImportError without xarray.")
      .def(
          "school_pings_dataset", [](const Product& p) { return dataset_of(p.school_pings(), "row", "time"); },
          "xarray.Dataset [row] of schools in pings, named and described as in the product's netCDF: units, flags, "
          "coordinates time, latitude, longitude and depth_m. Times are datetime64[ns], equal to those of /pings. "
          "Raises ImportError without xarray.")
      .def_property_readonly("masks", &Product::masks, "list of Mask, by school and ping")
      .def(
          "school_ids",
          [](const Product& p, std::int64_t ping) {
            return array_of(p.school_ids(ping), shape_of(p.shape().value_or(Shape{})));
          },
          py::arg("ping"),
          "int32 [fan][beam][sample]: number of the school of each voxel of a ping; 0 = none. ping: from 0. Raises "
          "Error: "
          "usage (no such ping).")
      .def_property_readonly("notes", &Product::notes, "list of str: what is worth knowing, a line each")
      .def("with_masks", &Product::with_masks, py::arg("masks"),
           "A product with other masks in place of its own; its figures are as before until measure() works them out. "
           "masks: list of Mask, of schools that this product has; of its other schools nothing stays. Raises Error: "
           "bad_parameter (a mask that does not fit the grid, or of no school of the product).")
      .def("write", &Product::write, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "Writes one netCDF file, whole or not at all, into a folder that is there. Raises Error: not_found (no such "
           "folder), usage (recordings lie there), io, no_space.")
      .def("__repr__", [](const Product& p) {
        const Table schools = p.schools();
        const std::size_t rows = std::visit([](const auto& values) { return values.size(); }, schools.front().values);
        return words_of("<Product of {}, {} schools, {} masks>", p.observation(), rows, p.masks().size());
      });
  m.def("read_product", &Product::read, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
        "Reads what `sonarx run` or Product.write() wrote, products/obs-0001.nc. Returns a Product. Raises Error: "
        "not_found, io, format, newer_version, older_version.");
}

}  // namespace sonar_explorer::python
