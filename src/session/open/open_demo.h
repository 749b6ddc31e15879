// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "session/app_model.h"

namespace sonar {

/// Opens the simulated `demo` survey, made in a folder of the user's cache with its depth chart, where it is not there yet.
/// folder  empty = the user's
void open_demo(AppModel& app, std::filesystem::path folder = {});

}  // namespace sonar
