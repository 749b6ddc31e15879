// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/check.h"
#include "io/simrad/test_bytes.h"
#include "pipeline/survey/survey.h"

namespace sonar::test {

/// A survey that can be opened, without an index; for tests.
inline SurveyFiles opened(const std::vector<std::filesystem::path>& paths, const SurveyParams& params = {},
                          int threads = 2) {
  Work work(threads);
  auto survey = open_survey(paths, params, {}, IndexCache{}, work);
  SONAR_CHECK(survey.has_value());
  return std::move(*survey);
}

inline SurveyFiles opened(const TemporaryFolder& folder, const SurveyParams& params = {}) {
  return opened({folder.path()}, params);
}

inline std::int64_t count(const Diagnostics& notes, DiagnosticCode code) {
  return std::count_if(notes.begin(), notes.end(), [&](const Diagnostic& note) { return note.code == code; });
}

}  // namespace sonar::test
