// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/survey/survey.h"
#include "pipeline/tasks/merge.h"

namespace sonar {

/// Makes the product of one observation (index in the survey) when it is its turn.
using ProductSource = std::function<Result<ObservationProduct>(std::size_t observation)>;

/// Writes products that are made elsewhere as a run would leave them: FOLDER/products/obs-*.nc, whole or not at all.
/// out     the files written
/// errors  usage: the folder holds raw files, or a run's plan; io; no_space; cancelled; those of the source
/// memory  one product at a time
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_products(const SurveyFiles& survey,
                                                                        const std::filesystem::path& folder,
                                                                        const ProductSource& product, Work& work);

/// The same, merged: tables, map and survey.json beside the products, with the products' own school numbers.
/// errors  also as merge_folder()
[[nodiscard]] Result<MergeReport> write_survey(const SurveyFiles& survey, const std::filesystem::path& folder,
                                               const ProductSource& product, Work& work);

}  // namespace sonar
