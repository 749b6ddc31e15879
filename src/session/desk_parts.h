// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

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

void add_pictures(Desk& desk);  ///< the part of them that makes pictures and movies

/// Lets a human change some parameters first; what was there comes back where they decline.
/// names  in order; empty = all
template <class P>
[[nodiscard]] bool asked(const Desk& desk, const std::string& title, Parameters<P>& parameters,
                         std::vector<std::string> names = {}) {
  if (!desk.asking.parameters) return true;
  const P before = parameters.values();
  if (desk.asking.parameters(title, {title, std::make_shared<SourceOf<P>>(parameters), std::move(names)})) return true;
  parameters.assign(before);
  return false;
}

/// Writes the preferences with what the window shows now; what hinders it is told once.
void keep_preferences(Desk& desk);

}  // namespace sonar
