// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>
#include <QMenu>

#include "session/actions.h"

namespace sonar {

/// Menus and keys of a window. Texts, switches and greyed entries are asked for whenever a menu opens.
void add_menus(QMainWindow& window, Actions& actions);

/// The menu that a right click into a dock opens, of the window's own actions: add_menus() comes first.
QMenu* add_context_menu(QMainWindow& window, const std::string& dock, const Actions& actions);

/// Property of a menu, true while it is open beside every school: acts on the selected one are not meant.
inline constexpr const char* kBesideSchools = "beside_schools";

/// The Qt action of an id; null where there is none.
[[nodiscard]] QAction* find_action(const QMainWindow& window, const std::string& id);

}  // namespace sonar
