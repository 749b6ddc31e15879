// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"

namespace sonar {

/// Sv of one beam or fan of an observation against time, with the schools in it; of a sounder without a grid, one channel.
/// With `below` another observation's under the same time axis. Without raw files the schools alone.
/// source       where the other observation is looked for
/// observation  of the source
/// errors       usage: no such fan, beam, channel, ping, school or other observation, no log; bad_parameter: too small;
///              not_found, io, format: of the line
[[nodiscard]] Result<FrameDescription> echogram_frame(PictureSource& source, DrawnObservation& observation,
                                                      const PictureOptions& options, Work& work);

}  // namespace sonar
