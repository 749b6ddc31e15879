// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

#include "session/parameter_source.h"

namespace sonar {

/// The controls of a section below each other, each with its label and notes.
[[nodiscard]] QWidget* panel_section(const PanelSection& section, QWidget* parent);

}  // namespace sonar
