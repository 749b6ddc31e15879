// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// The slice that the options choose: of a kind of slices, or of that which noise steps are shown of.
/// errors  usage: a slice that the sector has not
[[nodiscard]] Result<Slice> chosen_slice(PictureKind kind, const DrawnPing& ping, const Sector& sector,
                                         const PictureOptions& options);
/// The ping that a slice's title names.
[[nodiscard]] SlicePing titled_ping(const DrawnObservation& observation, const DrawnPing& ping);
/// Turns a slice that is seen from above as the options have it.
[[nodiscard]] SliceView drawn_view(const Slice& slice, const DrawnPing& ping, const PictureOptions& options);

/// One of the four slice kinds. Without raw files the masks alone are drawn, and the title says so.
/// errors  as DrawnObservation::ping() and slice_picture(); usage: a slice that the sector has not
[[nodiscard]] Result<FrameDescription> slice_frame(PictureKind kind, DrawnObservation& observation,
                                                   const PictureOptions& options, Work& work);

}  // namespace sonar
