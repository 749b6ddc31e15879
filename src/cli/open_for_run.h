// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "cli/run_survey.h"
#include "pipeline/journal/journal.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/run.h"

namespace sonar {

/// A survey with what is to be done to it.
struct Opened {
  Plan plan;
  SurveyFiles survey;
  std::vector<JournalLine> journal;
};

/// The survey of the arguments, or of the plan that they name, indexed.
[[nodiscard]] Result<Opened> open_for_run(const RunArguments& arguments, Work& work);
/// Makes the plan and writes it to OUT/plan.json; products that it calls for anew are set aside.
[[nodiscard]] Result<void> write_plan(Opened& opened, const RunArguments& arguments, const RunOptions& options);
/// Files that gave nothing, each with the reason.
[[nodiscard]] std::vector<RunFailure> failed_files(const SurveyFiles& survey);
/// Notes on the survey as a whole, then the failures, a line each on standard error.
void print_failures(const SurveyFiles& survey, const RunReport& report);

}  // namespace sonar
