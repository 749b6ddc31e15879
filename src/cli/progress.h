// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/work.h"

namespace sonar {

/// Draws a progress line on standard error while it is a terminal, at most ten times a second, with the time left. Where
/// --verbose asks for it each stage has a line, above the progress or in a pipe.
void show_progress(Work& work);
/// Takes the line away before a result or an error is printed.
void clear_progress();

}  // namespace sonar
