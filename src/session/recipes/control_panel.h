// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "session/open/workspace.h"
#include "session/recipes/parameter_source.h"

namespace sonar {

/// The control panel's sections, below its transfer function: the dozen settings that matter first, each with its sentence, then
/// all others, folded.
[[nodiscard]] std::vector<PanelSection> control_panel(Workspace& workspace);

/// Of them the one about the colours of Sv.
[[nodiscard]] PanelSection colours_section(Workspace& workspace);

/// Texts of the parameters of pictures that are one of a list: columns of tables.
[[nodiscard]] std::vector<PanelSection::Words> picture_words();

/// What a user sets of the picture of noise steps, in order.
[[nodiscard]] std::vector<std::string> noise_steps_settings();

/// How far below a growth's reference a confidence lies, dB: f = 1 - (d / tolerance)^2.
[[nodiscard]] double db_below_reference(double confidence, double tolerance_db);

}  // namespace sonar
