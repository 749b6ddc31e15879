// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

#include "session/actions.h"

namespace sonar {

/// The sheet of keys, made from the actions that there are; looked up by name, closed by Escape.
void show_key_sheet(QWidget& parent, const Actions& actions);

}  // namespace sonar
