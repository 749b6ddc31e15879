// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <sonar_explorer/stop.h>

#include <chrono>
#include <future>
#include <utility>

namespace sonar_explorer::python {

/// Runs what takes long beside the interpreter, which other threads use meanwhile; Ctrl-C ends it.
template <class Task>
auto interruptible(Task task) {
  auto done = std::async(std::launch::async, std::move(task));
  for (;;) {
    {
      const pybind11::gil_scoped_release released;
      if (done.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready) break;
    }
    if (PyErr_CheckSignals() == 0) continue;
    {
      // Whatever has not begun its work yet is stopped at the next try.
      const pybind11::gil_scoped_release released;
      do {
        stop_running();
      } while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready);
    }
    throw pybind11::error_already_set();
  }
  return done.get();
}

}  // namespace sonar_explorer::python
