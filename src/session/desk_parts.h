// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/desk.h"

namespace sonar {

// What a desk is put together from; each part adds its docks and its actions.
void add_slices(Desk& desk);       ///< slices, the tools in them, stepping and playing through pings
void add_volume(Desk& desk);       ///< the view in three dimensions
void add_maps(Desk& desk);         ///< observation map, propagation strip, survey map, timelines
void add_lists(Desk& desk);        ///< survey tree, tables of schools, review, journal, diagnostics
void add_school_acts(Desk& desk);  ///< what is done to the selected school
void add_window_acts(Desk& desk);  ///< views on and off, light and dark, help
void add_exports(Desk& desk);      ///< opening; files, pictures and movies out of the program

/// Writes the preferences with what the window shows now; what hinders it is told once.
void keep_preferences(Desk& desk);

}  // namespace sonar
