// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "session/app_model.h"

namespace sonar {

/// A period of the survey's transects, and where it begins.
struct SurveyPeriod {
  Transect period;
  std::size_t observation = 0;
  std::int64_t first_ping = 0;
  friend bool operator==(const SurveyPeriod&, const SurveyPeriod&) = default;
};

/// Those in which a ping of the survey lies, in the order of time.
[[nodiscard]] std::vector<SurveyPeriod> survey_periods(const Workspace& workspace);

/// Reads a table of transects; a line tells what is wrong with it, and what was there stays.
void open_transects(Workspace& workspace, const std::filesystem::path& file);

}  // namespace sonar
