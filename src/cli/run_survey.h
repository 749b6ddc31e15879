// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/chosen_recipe.h"
#include "pipeline/journal/journal.h"
#include "pipeline/recipe/recipe.h"

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

/// What a newer program planned here is not ours to replace.
/// errors  newer_version
[[nodiscard]] Result<void> require_no_newer_plan(const std::filesystem::path& out);

/// The verb `run`. Products that are right stay.
[[nodiscard]] int run_survey(const RunArguments& arguments);

}  // namespace sonar
