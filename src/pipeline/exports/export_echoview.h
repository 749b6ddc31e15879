// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"

namespace sonar {

/// DEST/obs-0001-fan-03.evr for each fan that schools are seen in (fans from 0, the deepest), and DEST/obs-0001-seabed.evl where
/// the seabed's depth is known.
/// product  with its masks
/// errors   io, no_space
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_echoview(const ObservationProduct& product,
                                                                         const std::filesystem::path& dest,
                                                                         const Work& work);

}  // namespace sonar
