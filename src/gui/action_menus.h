// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>

#include "session/actions.h"

namespace sonar {

/// Menus and keys of a window. Texts, switches and greyed entries are asked for whenever a menu opens.
void add_menus(QMainWindow& window, const Actions& actions);

/// The Qt action of an id; null where there is none.
[[nodiscard]] QAction* find_action(const QMainWindow& window, const std::string& id);

}  // namespace sonar
