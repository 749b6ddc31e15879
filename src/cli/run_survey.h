// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/chosen_recipe.h"
#include "pipeline/journal/journal.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/tasks/open_for_run.h"

namespace sonar {

struct RunArguments {
  std::vector<std::string> survey;
  std::string out;
  std::string recipe;
  Measured measured;
  std::string session;
  std::string plan;
  std::string only;
  std::string pings;
  std::int64_t task = 0;
  bool has_task = false;
  bool remeasure = false;
  bool why = false;
  bool json = false;
  int jobs = 0;
};

/// A recipe that was asked for; else the one that the session's choices were made under; else the default.
[[nodiscard]] Result<Recipe> recipe_for(const RunArguments& arguments, const Journal& journal);
/// The arguments outlive what comes back.
[[nodiscard]] RunSources sources_of(const RunArguments& arguments);

/// The verb `run`. Products that are right stay.
[[nodiscard]] int run_verb(const RunArguments& arguments);

}  // namespace sonar
