// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "session/open_observation.h"
#include "session/workspace.h"
#include "view/slice_picture.h"

namespace sonar {

/// What is done with samples that noise removal took out, and with weak ones (which carry low_snr here): faults are
/// hatched or left out, places without water are faded or left out.
[[nodiscard]] FlagStyle flag_style(const DisplayParams& display);

/// Colours of the display scale, or of the view curve where a human has changed that.
[[nodiscard]] SvColours slice_colours(const Workspace& workspace);

/// Flags of some rows of a ping, low_snr set where filtered Sv lies less than a margin above the expected background.
/// out  of the ping's shape; other rows stay as they are
void flag_weak_rows(const StagedPing& ping, const std::vector<int>& rows, double margin_db, View3<SampleFlags> out);

/// Filtered Sv above the expected background, dB; empty where one of them is not known.
[[nodiscard]] std::optional<double> signal_to_noise_db(const StagedPing& ping, int row, int sample);

}  // namespace sonar
