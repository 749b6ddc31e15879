// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// The raw files that a product was made from.
/// errors  mismatch: the survey's observation has not the product's pings
[[nodiscard]] Result<const ObservationFiles*> raw_files_of(const SurveyFiles& survey,
                                                           const ObservationProduct& product);

/// Writes the calibrated Sv of an observation with its masks: DEST/obs-0001-sv.nc, or where that would be larger than
/// 256 MB unpacked obs-0001-sv-001.nc and so on, the pings in order.
/// product  with its masks and background levels; nothing is written of one without a grid
/// errors   mismatch: the survey's observation has not the product's pings; io, no_space; cancelled
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_sv(const SurveyFiles& survey,
                                                                   const ObservationProduct& product,
                                                                   const Recipe& recipe,
                                                                   const std::filesystem::path& dest, Work& work);

}  // namespace sonar
