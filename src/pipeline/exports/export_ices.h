// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "model/product.h"

namespace sonar {

/// The tables that `integrate` left in a work folder as ICES acoustic XML: DEST/acoustic.xml of all backscatter, and where
/// schools were looked for DEST/acoustic-schools.xml of theirs alone.
/// product  of the survey, for what is told of the instrument
/// errors   not_found, saying to integrate first; format; io, no_space
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_ices(const ObservationProduct& product,
                                                                     const std::filesystem::path& out,
                                                                     const std::filesystem::path& dest);

}  // namespace sonar
