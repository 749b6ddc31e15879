// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QWidget>

#include "session/app_model.h"
#include "session/figures/figure_model.h"

namespace sonar {

/// Lets a human compose a page of several views, with a preview of it, and write it.
void compose_figure(QWidget& window, AppModel& app, FigureModel& figure);

}  // namespace sonar
