// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "session/document.h"

namespace sonar {

/// Opens the simulated `demo` survey, made in a folder of the user's cache where it is not there yet.
/// folder  empty = the user's
void open_demo(Document& document, std::filesystem::path folder = {});

}  // namespace sonar
