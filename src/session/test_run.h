// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"
#include "session/test_survey.h"

namespace sonar {

/// What `sonarx run` leaves of the small simulated survey: products and plan, without tables; for tests.
inline Result<Plan> run_easy(const std::filesystem::path& out, const Recipe& recipe = {}) {
  const std::vector<std::filesystem::path> paths{TestSurvey::easy().folder()};
  Work work;
  const auto survey = open_survey(paths, recipe.survey, recipe.navigation, {}, work);
  if (!survey) return pass_on(survey);
  Plan plan = make_plan(*survey, paths, {}, recipe, {{}, {}, "test"});
  RunOptions options;
  options.out = out;
  options.program_version = "test";
  const auto report = run_plan(plan, *survey, {}, options, work);
  if (!report) return pass_on(report);
  std::ofstream(out / "plan.json") << plan_text(plan);
  return plan;
}

}  // namespace sonar
