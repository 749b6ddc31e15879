// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/survey/survey.h"
#include "pipeline/survey/test_ek60.h"
#include "session/test_survey.h"

namespace sonar {

/// A sounder with 38 and 120 kHz over the time of the simulated survey's first observation; for tests.
/// fans  that survey beside it
inline std::filesystem::path with_ek60(bool fans) {
  const std::filesystem::path folder = TestSurvey::easy().fresh() / "both";
  std::filesystem::create_directories(folder);
  Work work;
  const std::vector<std::filesystem::path> easy{TestSurvey::easy().folder()};
  const auto survey = open_survey(easy, {}, {}, IndexCache{}, work);
  const ObservationFiles& first = survey->observations.front();
  if (fans) {
    for (const auto& file : survey->files) {
      std::filesystem::copy_file(file.path, folder / file.path.filename());
    }
  }
  test::write_ek60(folder / "ek60.raw", survey->ping_time(first, 0));
  return folder;
}

}  // namespace sonar
