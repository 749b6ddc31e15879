// SPDX-License-Identifier: Apache-2.0
// The module sonar_explorer: the library's facade as Python sees it. Arrays are NumPy's and share the library's memory.
#include <pybind11/pybind11.h>

#include <sonar_explorer/error.h>
#include <sonar_explorer/ping.h>
#include <sonar_explorer/version.h>

#include "bindings.h"

namespace py = pybind11;

namespace sonar_explorer::python {
namespace {

/// Error, with its kind as an attribute.
void bind_error(py::module_& m) {
  static py::exception<Error> error(m, "Error");
  error.attr("__doc__") =
      "What could not be done: one line, as the command line prints it. `kind` says of which kind: 'not_found', 'io', "
      "'no_space', 'format', 'newer_version', 'older_version', 'mismatch', 'usage', 'bad_parameter', 'unsupported' or "
      "'cancelled'. Arguments of a wrong type are a TypeError instead.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& caught) {
      const py::object made = static_cast<const py::object&>(error)(caught.what());
      made.attr("kind") = caught.kind();
      PyErr_SetObject(error.ptr(), made.ptr());
    }
  });
}

void bind_constants(py::module_& m) {
  m.attr("__version__") = version();
  m.attr("DB_PER_COUNT") = kDbPerCount;
  m.attr("NO_DATA") = kNoData;
  m.attr("NEAR_FIELD") = int{kNearField};
  m.attr("SURFACE") = int{kSurface};
  m.attr("CORRUPTED_PACKETS") = int{kCorruptedPackets};
  m.attr("DROPOUT") = int{kDropout};
  m.attr("INTERFERENCE") = int{kInterference};
  m.attr("IMPULSE_NOISE") = int{kImpulseNoise};
  m.attr("SEABED") = int{kSeabed};
  m.attr("LOW_SNR") = int{kLowSnr};
}

}  // namespace
}  // namespace sonar_explorer::python

PYBIND11_MODULE(sonar_explorer, m) {
  using namespace sonar_explorer::python;
  m.doc() =
      "Fish schools in 4D fishery-sonar surveys: open a survey, look at pings, select, detect and measure schools.\n\n"
      "DB_PER_COUNT: dB of one count of power and Sv, 10 log10(2) / 256. NO_DATA: the count of a sample that is not "
      "there. NEAR_FIELD to LOW_SNR: bits of Ping.flags.";
  bind_constants(m);
  bind_error(m);
  bind_recipe(m);
  bind_pings(m);
  bind_survey(m);
  bind_product(m);
  bind_schools(m);
  refuse_in_one_line(m);
}
