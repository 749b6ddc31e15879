// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"

namespace sonar {

/// The surface of every school that is not rejected, in its strongest ping, whole where there is one such: mask_surface() in
/// the metres of LocalFrame. A school without a mask there, or whose ping has no position or heading, has none.
/// product  with its masks
/// errors   io, no_space; cancelled

/// DEST/obs-0001-school-3-ping-12.ply and so on.
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_ply(const ObservationProduct& product,
                                                                    const std::filesystem::path& dest,
                                                                    const Work& work);
/// DEST/obs-0001.glb, with a node a school; no file where none has a surface.
/// errors   also unsupported: more than the 4 GB that the format holds
[[nodiscard]] Result<std::vector<std::filesystem::path>> export_glb(const ObservationProduct& product,
                                                                    const std::filesystem::path& dest,
                                                                    const Work& work);

}  // namespace sonar
