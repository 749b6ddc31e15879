// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

#include "session/actions.h"

namespace sonar {

/// Answers what the app asks by dialogs over a window.
void answer_questions(QWidget& window, Dialogs& dialogs);

}  // namespace sonar
