// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QMainWindow>

namespace sonar {

/// Puts a window's docks, by their object names, where a fresh user finds them: survey at the left, slices, volume and maps
/// in the middle, timelines and tables below, controls at the right.
void lay_out_docks(QMainWindow& window);

}  // namespace sonar
