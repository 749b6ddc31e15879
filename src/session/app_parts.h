// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "session/app_model.h"

namespace sonar {

// What an app is put together from; each part adds its docks and its actions.
void add_slices(AppModel& app);              ///< slices, the tools in them, stepping and playing through pings
void add_volume(AppModel& app);              ///< the view in three dimensions
void add_maps(AppModel& app);                ///< observation map, propagation strip, survey map, timelines
void add_transects(AppModel& app);           ///< what a table tells of the survey's transects
void add_noise_steps(AppModel& app);         ///< a slice at each step of noise removal
void add_charts(AppModel& app);              ///< figures of schools, one over another
void add_lists(AppModel& app);               ///< survey tree, tables of schools, review, journal, diagnostics
void add_school_acts(AppModel& app);         ///< what is done to the selected school
void add_window_acts(AppModel& app);         ///< views on and off, light and dark, help
void add_window_preferences(AppModel& app);  ///< theme, playback, memory, keys
void add_numbers(AppModel& app);             ///< echo integration, numbers and biomass of fish
void add_exports(AppModel& app);             ///< opening; files, pictures and movies out of the program
void add_batch(AppModel& app);               ///< whole surveys run behind the window

void add_pictures(AppModel& app);  ///< the part of them that makes pictures and movies

/// Lets a human change some parameters first; what was there comes back where they decline.
/// names  in order; empty = all
template <class P>
[[nodiscard]] bool asked(const AppModel& app, const std::string& title, Parameters<P>& parameters,
                         std::vector<std::string> names = {}) {
  if (!app.dialogs.parameters) return true;
  const P before = parameters.values();
  PanelSection section{title, std::make_shared<SourceOf<P>>(parameters), std::move(names)};
  section.words = picture_words();
  if (app.dialogs.parameters(title, section)) return true;
  parameters.assign(before);
  return false;
}

/// Runs the surveys of the batch. A human is asked before results under another recipe are replaced.
/// errors  as Batch::start()
Result<void> start_batch(AppModel& app);
/// Shows the survey with what its run found; without that where it has not begun.
void open_run_survey(AppModel& app, std::size_t at);
/// Asks whether surveys that run are to be stopped, and stops them; false = the human declined.
[[nodiscard]] bool batch_may_end(AppModel& app);

/// The chart of schools shows Sv over the incidence angle in each ping.
void show_incidence_chart(Workspace& workspace);

/// Asks for a folder to write into, and proposes one beside the survey; empty = the human declined.
/// ending  of its name: "-out"
[[nodiscard]] std::string asked_folder(AppModel& app, const std::string& title, const std::string& ending);

/// Shows a page of the manual, or tells why it cannot.
/// page     where it lies; empty = nowhere
/// in_tree  its place in a source tree
void show_page(AppModel& app, const std::filesystem::path& page, const char* in_tree);

/// Writes the preferences with what the window shows now; what hinders it is told once.
void keep_preferences(AppModel& app);

}  // namespace sonar
