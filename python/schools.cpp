// SPDX-License-Identifier: Apache-2.0
#include <sonar_explorer/schools.h>

#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "bindings.h"
#include "interruptible.h"

namespace py = pybind11;

namespace sonar_explorer::python {
namespace {

using Voxel = std::tuple<int, int, int>;  ///< fan, beam, sample
using Voxels = std::variant<Voxel, std::vector<Voxel>>;

std::vector<Seed> seeds_of(const Voxels& voxels) {
  const auto seed = [](const Voxel& at) { return Seed{std::get<0>(at), std::get<1>(at), std::get<2>(at)}; };
  if (const auto* one = std::get_if<Voxel>(&voxels)) return {seed(*one)};
  std::vector<Seed> seeds;
  for (const Voxel& at : std::get<std::vector<Voxel>>(voxels)) seeds.push_back(seed(at));
  return seeds;
}

/// The docstring of grow() and propagate(), behind what sets them apart.
std::string said_of_growing(const char* before) {
  return std::string(before) +
         "ping: number of the ping, from 0\n"
         "seeds: a voxel (fan, beam, sample), from 0, or a list of them; what they grow is joined\n"
         "tolerance_db: of mode 'tracked', dB, 0.1 to 60: members lie at most this much below the reference level\n"
         "tolerance_opacity: of mode 'paper', 0 to 1: members differ at most this much in opacity\n"
         "mode: 'tracked' compares Sv, 'paper' compares opacity as the article of 2007 did\n"
         "None = as the survey's recipe says: grow.tolerance_db and propagate_tracked.tolerance_db (10 dB by default), "
         "grow.tolerance_opacity (0.1), grow.mode ('tracked').\n"
         "Returns a Product with that one school. Raises Error: usage (no such ping, or the beams make no grid), "
         "bad_parameter (no such voxel, nothing grows there, a value out of its range or of the other mode), io.";
}

}  // namespace

void bind_schools(py::module_& m) {
  m.def(
      "detect", [](const Observation& o) { return interruptible([&] { return detect(o); }); }, py::arg("observation"),
      "Schools of an observation, detected, tracked and measured: what `sonarx run` makes of it. Returns a Product. "
      "Raises Error: usage (the beams make no grid), io.");
  m.def(
      "grow",
      [](const Observation& o, std::int64_t ping, const Voxels& seeds, std::optional<double> db,
         std::optional<double> opacity, std::optional<std::string> mode) {
        return interruptible([&, list = seeds_of(seeds), options = GrowOptions{db, opacity, std::move(mode)}] {
          return grow(o, ping, list, options);
        });
      },
      py::arg("observation"), py::arg("ping"), py::arg("seeds"), py::arg("tolerance_db") = py::none(),
      py::arg("tolerance_opacity") = py::none(), py::arg("mode") = py::none(),
      said_of_growing("Grows one school in one ping, as a click selects it.\n").c_str());
  m.def(
      "propagate",
      [](const Observation& o, std::int64_t ping, const Voxels& seeds, std::int64_t reach, std::optional<double> db,
         std::optional<double> opacity, std::optional<std::string> mode) {
        return interruptible([&, list = seeds_of(seeds), options = GrowOptions{db, opacity, std::move(mode)}] {
          return propagate(o, ping, list, reach, options);
        });
      },
      py::arg("observation"), py::arg("ping"), py::arg("seeds"), py::arg("reach") = -1,
      py::arg("tolerance_db") = py::none(), py::arg("tolerance_opacity") = py::none(), py::arg("mode") = py::none(),
      said_of_growing("Grows one school in one ping and follows it through the pings before and after.\n"
                      "reach: pings to each side; negative = as far as it goes\n")
          .c_str());
  m.def(
      "measure",
      [](const Observation& o, const Product& product) { return interruptible([&] { return measure(o, product); }); },
      py::arg("observation"), py::arg("product"),
      "Works all figures of a product's masks out anew, under the recipe that the survey was opened with. Returns a "
      "Product. Raises Error: mismatch (the product is of other pings), io.");
}

}  // namespace sonar_explorer::python
