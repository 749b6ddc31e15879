// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>

#include "model/product.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// What a run found in an observation, or made of it, that is not this version's find under this recipe.
struct OtherFind {
  std::filesystem::path file;
  std::shared_ptr<const ObservationProduct> product;  ///< without background levels
};

/// By observation, from the same pings on the same grid under the same recipe, so that masks lie where they lay:
/// - what another version found, or what `--remeasure` measured anew, without decisions; in the first folder that has either
///   this or the following;
/// - a product with decisions, where the run's journal has no line, not even one that was taken back, that could have
///   changed a mask. A journal that is gone, or that has broken lines, says nothing of that.
/// version  this one's
/// known    observations that are not asked for
[[nodiscard]] std::map<std::size_t, OtherFind> other_finds(std::span<const std::filesystem::path> work_folders,
                                                           const SurveyFiles& survey, const Recipe& recipe,
                                                           const std::string& version,
                                                           const std::set<std::size_t>& known);

}  // namespace sonar
