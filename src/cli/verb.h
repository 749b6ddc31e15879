// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "base/work.h"

namespace sonar {

/// What a verb does once its options are parsed; returns an exit code of cli/exit_codes.h. A verb makes its own Work and
/// lets CancelOnInterrupt watch it.
using VerbRunner = std::function<int()>;

// Each verb's file adds one subcommand, whose callback puts the work to be done into `run`.
void add_info(CLI::App& app, VerbRunner& run);
void add_simulate(CLI::App& app, VerbRunner& run);
void add_calibrate(CLI::App& app, VerbRunner& run);
void add_run(CLI::App& app, VerbRunner& run);
void add_plan(CLI::App& app, VerbRunner& run);
void add_follow(CLI::App& app, VerbRunner& run);
void add_merge(CLI::App& app, VerbRunner& run);
void add_submit(CLI::App& app, VerbRunner& run);
void add_status(CLI::App& app, VerbRunner& run);
void add_check(CLI::App& app, VerbRunner& run);
void add_integrate(CLI::App& app, VerbRunner& run);
void add_biomass(CLI::App& app, VerbRunner& run);
void add_propagate(CLI::App& app, VerbRunner& run);
void add_import(CLI::App& app, VerbRunner& run);
void add_export(CLI::App& app, VerbRunner& run);
void add_score(CLI::App& app, VerbRunner& run);
void add_agree(CLI::App& app, VerbRunner& run);
void add_compare(CLI::App& app, VerbRunner& run);
void add_recipe(CLI::App& app, VerbRunner& run);
void add_render(CLI::App& app, VerbRunner& run);

/// Lets Ctrl-C cancel this work while it lives; several may be watched at once (up to 8).
class CancelOnInterrupt {
 public:
  explicit CancelOnInterrupt(Work& work);
  ~CancelOnInterrupt();
  CancelOnInterrupt(const CancelOnInterrupt&) = delete;
  CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;

 private:
  int slot_;
};

/// Whether Ctrl-C was pressed.
[[nodiscard]] bool interrupted();

}  // namespace sonar
