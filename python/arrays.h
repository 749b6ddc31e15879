// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <sonar_explorer/ping.h>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

// NumPy's arrays of the library's memory.
namespace sonar_explorer::python {

/// An array of the library's memory, which lives as long as the array. Nobody may write to it.
template <class T, class Owner>
pybind11::array_t<T> view_of(std::span<const T> values, const std::vector<pybind11::ssize_t>& shape,
                             const Owner& owner) {
  const auto keep = pybind11::capsule(new Owner(owner), [](void* held) { delete static_cast<Owner*>(held); });
  pybind11::array_t<T> array(shape, values.data(), keep);
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

/// The values moved into an array.
template <class T>
pybind11::array_t<T> array_of(std::vector<T> values, const std::vector<pybind11::ssize_t>& shape) {
  auto held = std::make_shared<std::vector<T>>(std::move(values));
  return view_of<T>(std::span<const T>(*held), shape, held);
}
template <class T>
pybind11::array_t<T> array_of(std::vector<T> values) {
  const auto size = static_cast<pybind11::ssize_t>(values.size());
  return array_of(std::move(values), {size});
}

inline std::vector<pybind11::ssize_t> shape_of(const Shape& shape) { return {shape.fans, shape.beams, shape.samples}; }

inline pybind11::tuple tuple_of(const Shape& shape) {
  return pybind11::make_tuple(shape.fans, shape.beams, shape.samples);
}

/// What repr() tells: words with {} for values, as str.format() fills them in.
template <class... Values>
pybind11::str words_of(const char* format, const Values&... values) {
  return pybind11::str(format).format(values...);
}

}  // namespace sonar_explorer::python
