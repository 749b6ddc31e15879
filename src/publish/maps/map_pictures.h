// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"

namespace sonar {

/// errors  usage: no such ping or school; not_found: no positions; bad_parameter
[[nodiscard]] Result<FrameDescription> observation_map_frame(const DrawnObservation& observation,
                                                             const PictureOptions& options);
/// errors  usage: no such ping or school; not_found: no schools; unsupported: no grid
[[nodiscard]] Result<FrameDescription> propagation_frame(const DrawnObservation& observation,
                                                         const PictureOptions& options);
/// errors  as above; what the depth raster refuses
[[nodiscard]] Result<FrameDescription> survey_map_frame(const std::vector<DrawnObservation>& observations,
                                                        const PictureOptions& options, Work& work);
/// With raw files an echogram of every ping is made first.
/// errors  as above; usage: no log
[[nodiscard]] Result<FrameDescription> timeline_frame(const std::vector<DrawnObservation*>& observations,
                                                      const PictureOptions& options, Work& work);

}  // namespace sonar
