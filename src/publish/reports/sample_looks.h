// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/sample_flags.h"
#include "publish/picture_params.h"
#include "view/slices/slice_picture.h"

namespace sonar {

/// What is done with samples that noise removal took out, and with weak ones (which carry low_snr here): faults are
/// hatched or left out, places without water are faded or left out.
[[nodiscard]] FlagStyle flag_style(const DisplayParams& display);

/// How a slice looks that a user set so, but for its colours.
[[nodiscard]] SliceStyle slice_style(const DisplayParams& display, SvColours colours);

/// Reasons whose samples are shown as recorded: those that are not taken out.
[[nodiscard]] SampleFlags put_back(const DisplayParams& display);

/// Samples that a volume leaves out: stripes cannot be told apart there, so that what slices hatch is left out too.
[[nodiscard]] SampleFlags left_out_of_volume(const DisplayParams& display);

/// Below which signal-to-noise samples carry low_snr, dB; empty where weak ones look as others do.
[[nodiscard]] std::optional<double> weak_below(const DisplayParams& display);

}  // namespace sonar
