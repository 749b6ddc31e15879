// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include "cli/verb.h"

namespace sonar {

/// What all verbs have in common, once they are there: --quiet and --verbose, examples, where the manual lies, and help in plain
/// words; and the verb `help`.
void add_help(CLI::App& app, VerbRunner& run);

}  // namespace sonar
