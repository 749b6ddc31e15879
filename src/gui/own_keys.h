// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

namespace sonar {

/// Leaves a control the keys that it is worked with while it has the keyboard, where the window's own would take them: arrows,
/// Space, Enter. Controls that need no typing take the keyboard by Tab and not by a click, so that after a drag of a
/// slider the arrows go on to step through pings. Enter in a field ends it and gives the keyboard back. The wheel scrolls the
/// panel and changes only the control that has the keyboard.
void keep_own_keys(QWidget& control);

}  // namespace sonar
