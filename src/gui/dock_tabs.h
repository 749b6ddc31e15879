// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>

namespace sonar {

/// Tabs of docks that share a place: their words are whole, and the bar scrolls where it is too narrow for them. A dock behind
/// others comes in front when Tab brings the keyboard into it. The window's docks are there.
void keep_dock_tabs(QMainWindow& window);

}  // namespace sonar
