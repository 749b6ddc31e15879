// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/sample_flags.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/engine.h"
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

/// SliceData::shadow_from of the masks that are drawn, also of ContextParams.
[[nodiscard]] std::vector<int> shadow_of_schools(const StagedPing& ping, const Sector& sector,
                                                 std::span<const MaskLayer> masks, const ExtinctionParams& extinction,
                                                 const DisplayParams& display);

/// Of masks that are drawn, those that take sound out of beams: no school that a human rejected.
[[nodiscard]] std::vector<const PingMask*> schools_of(std::span<const MaskLayer> masks);

}  // namespace sonar
