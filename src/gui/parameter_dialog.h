// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>
#include <string>

#include "session/parameter_source.h"

namespace sonar {

/// Lets a human change the parameters of a section; they follow at once.
/// out  false where the human declined
[[nodiscard]] bool change_parameters(QWidget& window, const std::string& title, const PanelSection& section);

}  // namespace sonar
