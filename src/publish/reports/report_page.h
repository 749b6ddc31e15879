// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/frame_description.h"

namespace sonar {

/// One A4 page of a survey, upright: what it is, its map, its timeline and its strongest school where raw files are there,
/// its strongest schools in a table, and what the numbers mean. Of options it knows dark, scale, the colours of Sv and the
/// depth raster; the size is the paper's.
/// errors  cancelled; what the depth raster refuses
[[nodiscard]] Result<FrameDescription> report_page(PictureSource& source, const PictureOptions& options, Work& work);

}  // namespace sonar
