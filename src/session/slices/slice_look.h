// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/sample_flags.h"
#include "session/workspace.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// What is done with samples that noise removal took out, and with weak ones (which carry low_snr here): faults are
/// hatched or left out, places without water are faded or left out.
[[nodiscard]] FlagStyle flag_style(const DisplayParams& display);

/// Colours of the display scale, or of the view curve where a human has changed that.
[[nodiscard]] SvColours slice_colours(const Workspace& workspace);

/// Reasons whose samples are shown as recorded: those that are not taken out.
[[nodiscard]] SampleFlags put_back(const DisplayParams& display);

/// Samples that a volume leaves out: stripes cannot be told apart there, so that what slices hatch is left out too.
[[nodiscard]] SampleFlags left_out_of_volume(const DisplayParams& display);

}  // namespace sonar
