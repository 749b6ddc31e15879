// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include "bindings.h"

namespace py = pybind11;

namespace sonar_explorer::python {
namespace {

/// From behind `before` to `end`, or as far as the text goes.
std::string between(const std::string& text, std::string_view before, std::string_view end) {
  const std::size_t first = text.find(before) + before.size();
  return text.substr(first, text.find(end, first) - first);
}

/// "ping: expected (index: int), got ('a')", of pybind11's several lines:
/// "ping(): incompatible function arguments. [...]:\n    1. (index: int) -> Ping\n\nInvoked with: 'a'".
py::str one_line(const std::string& text) {
  const std::string name = text.substr(0, text.find("()"));
  std::string expected = between(text, "1. ", "\n");
  expected = expected.substr(0, expected.rfind(" -> "));
  for (const std::string_view module = "sonar_explorer."; expected.find(module) != std::string::npos;) {
    expected.erase(expected.find(module), module.size());
  }
  // What was given may be arrays and long lists.
  const py::object got =
      py::module_::import("textwrap")
          .attr("shorten")(between(text, "Invoked with: ", "\n\nDid you forget"), 200, py::arg("placeholder") = "...");
  const bool named = !name.empty() && name != "__init__";
  return py::str("{}expected {}, got ({})").format(named ? name + ": " : "", expected, got);
}

PyCFunctionWithKeywords dispatch = nullptr;  // pybind11's, the same for every function

PyObject* dispatch_plainly(PyObject* self, PyObject* arguments, PyObject* keywords) {
  PyObject* const result = dispatch(self, arguments, keywords);
  if (result != nullptr || PyErr_ExceptionMatches(PyExc_TypeError) == 0) return result;
  try {
    py::error_already_set thrown;
    const std::string text = py::str(thrown.value());
    if (text.find("(): incompatible ") == std::string::npos) {
      thrown.restore();
    } else {
      PyErr_SetObject(PyExc_TypeError, one_line(text).ptr());
    }
  } catch (py::error_already_set& other) {
    other.restore();
  }
  return nullptr;
}

void refuse_in_one_line(const py::handle& thing) {
  if (PyCFunction_Check(thing.ptr())) {
    // Only functions of pybind11 (2.x) keep what they are in a capsule.
    if (!PyCapsule_CheckExact(PyCFunction_GET_SELF(thing.ptr()))) return;
    PyMethodDef& own = *reinterpret_cast<PyCFunctionObject*>(thing.ptr())->m_ml;
    if (own.ml_flags != (METH_VARARGS | METH_KEYWORDS)) return;
    if (dispatch == nullptr)
      dispatch = reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(own.ml_meth));
    own.ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(dispatch_plainly));
  }
  for (const char* inside : {"__func__", "fget", "fset"}) {
    if (py::hasattr(thing, inside)) refuse_in_one_line(thing.attr(inside));
  }
  if (!PyType_Check(thing.ptr()) && !PyModule_Check(thing.ptr())) return;
  for (const py::handle member : py::list(thing.attr("__dict__").attr("values")())) refuse_in_one_line(member);
}

}  // namespace

void refuse_in_one_line(const py::module_& m) { refuse_in_one_line(py::handle(m)); }

}  // namespace sonar_explorer::python
