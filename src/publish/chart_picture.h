// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "publish/picture_options.h"
#include "publish/picture_source.h"

namespace sonar {

/// Figures of schools, of one observation or of several; products are all it needs.
/// errors  usage: no such school, or no such column; not_found: no products, no schools, or nothing known of them
[[nodiscard]] Result<FrameDescription> chart_frame(const std::vector<DrawnObservation*>& observations,
                                                   const PictureOptions& options);

}  // namespace sonar
