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

// A file for each ping with a school that is not rejected, DEST/obs-0001-ping-00012.vtu, and DEST/obs-0001.vtu.pvd, which
// tells ParaView their times. Pings without position or heading, and observations without a grid, have none.

/// Voxels of the masks.
/// product  with its masks
/// errors   io, no_space; cancelled
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_vtu(const ObservationProduct& product,
                                                                    const std::filesystem::path& dest,
                                                                    const Work& work);

/// Sv of the whole sector with the masks, .vts instead of .vtu.
/// product  with its masks and background levels
/// errors   also mismatch: the survey's observation has not the product's pings
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_vts(const SurveyFiles& survey,
                                                                    const ObservationProduct& product,
                                                                    const Recipe& recipe,
                                                                    const std::filesystem::path& dest, Work& work);

}  // namespace sonar
