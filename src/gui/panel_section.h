// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QVBoxLayout>
#include <QWidget>

#include "session/recipes/parameter_source.h"

namespace sonar {

/// The controls of a section below each other, each with its label and notes.
[[nodiscard]] QWidget* panel_section(const PanelSection& section, QWidget* parent);

/// The same below a head with its title, which folds it.
void add_folding_section(QVBoxLayout& column, const PanelSection& section, QWidget* parent);

}  // namespace sonar
