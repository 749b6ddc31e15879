// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"
#include "base/work.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/observe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

// A window carries decisions out on what was found, and goes on with it: beside a product that holds decisions, OUT keeps
// the find at found_path(), a product like it without them.

/// The recipe by which schools are looked for before the journal's decisions are carried out; empty where the product is
/// itself what was found.
[[nodiscard]] std::optional<Recipe> recipe_of_find(const SurveyFiles& survey, const ObservationFiles& observation,
                                                   Recipe recipe, const ReadJournal& journal);

/// Finds what is not there yet, or not right; forgets what is there where the product is itself what was found.
/// recipe   recipe_of_find()
/// options  of the product; its journal is left out, what its memory holds is not worked out again for the product
/// errors   observe()'s; write_product()'s
[[nodiscard]] Result<void> keep_find(const SurveyFiles& survey, const ObservationFiles& observation,
                                     const std::optional<Recipe>& recipe, ObserveOptions options,
                                     const std::filesystem::path& out, Work& work);

/// Measures a find that is there anew, as its product is that keeps its masks; nothing where there is none of these pings,
/// or it is right as it is.
/// errors  remeasure()'s; write_product()'s
[[nodiscard]] Result<void> remeasure_find(const SurveyFiles& survey, const ObservationFiles& observation,
                                          const Recipe& recipe, ObserveOptions options,
                                          const std::filesystem::path& out, Work& work);

/// Key of a product whose masks were kept: begins with the plan's key, goes on with the masks' own.
[[nodiscard]] std::string remeasured_key(const std::string& key, const ObservationProduct& before);
[[nodiscard]] bool is_remeasured(const ObservationProduct& product);

}  // namespace sonar
