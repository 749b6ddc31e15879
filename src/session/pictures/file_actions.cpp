// SPDX-License-Identifier: Apache-2.0
// What is opened, and what goes out of the program.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "base/number_text.h"
#include "pipeline/exports/export.h"
#include "pipeline/survey/calibration_json.h"
#include "pipeline/tasks/named_surveys.h"
#include "session/app_parts.h"
#include "session/lists/calibration_table.h"
#include "session/live/live_watch.h"
#include "session/open/open_demo.h"
#include "session/pictures/exports.h"
#include "session/recipes/recipe_editor.h"
#include "session/recipes/recipe_preview.h"
#include "session/setup/setup_page.h"
#include "session/setup/sphere_page.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "&File";
constexpr const char* kCalibrations = "Calibrations and recipes (*.csv *.json *.CSV *.JSON);;All files (*)";
constexpr const char* kExport = "&File/&Export";

std::function<bool()> with_survey(const AppModel& app) {
  return [&app] { return app.workspace.document.survey() != nullptr; };
}

void open_folder(AppModel& app) {
  if (!app.dialogs.folder_to_open) return;
  if (const std::string folder = app.dialogs.folder_to_open(); !folder.empty()) app.workspace.document.open({folder});
}

void open_files(AppModel& app) {
  if (!app.dialogs.files_to_open) return;
  const auto names = app.dialogs.files_to_open();
  if (!names.empty()) app.workspace.document.open({names.begin(), names.end()});
}

/// Whether one of the raw files that results were made of lies in a folder, by its name; of results that name none
/// nobody knows.
bool may_hold_raw_of(const SurveyFiles& results, const fs::path& folder) {
  std::set<fs::path> expected;
  for (const SurveyFile& file : results.files) {
    if (file.path.has_extension()) expected.insert(file.path.filename());
  }
  const auto there = list_survey(std::span(&folder, 1));
  return expected.empty() || (there && std::ranges::any_of(*there, [&](const fs::path& file) {
                                return expected.contains(file.filename());
                              }));
}

/// Beside the results that are open. Another survey would be opened under their recipe.
void find_raw(AppModel& app) {
  if (!app.dialogs.folder_to_open) return;
  Document& document = app.workspace.document;
  const std::string folder = app.dialogs.folder_to_open();
  if (folder.empty() || document.survey() == nullptr) return;
  if (!may_hold_raw_of(*document.survey(), folder)) {
    return document.tell(folder + ": none of the raw files that the results were made of is here");
  }
  std::vector<fs::path> named = document.named();
  named.emplace_back(folder);
  document.open(std::move(named));
}

std::string recent_text(const AppModel& app, std::size_t at) {
  if (at >= app.preferences.recent.size()) return {};
  return text_of(app.preferences.recent[at]);
}

void add_opening(AppModel& app) {
  app.actions.add({.id = "file.open_folder",
                   .menu = kFile,
                   .text = "Open folder...",
                   .keys = {"Ctrl+O"},
                   .tip = "Open a survey: a folder of raw files, or the folder of a run's results",
                   .run = [&app] { open_folder(app); }});
  app.actions.add({.id = "file.open_files",
                   .menu = kFile,
                   .text = "Open files...",
                   .keys = {"Ctrl+Shift+O"},
                   .tip = "Open some raw files as a survey",
                   .run = [&app] { open_files(app); }});
  app.actions.add({.id = "file.find_raw",
                   .menu = kFile,
                   .text = "Find raw files...",
                   .keys = {"Ctrl+Alt+O"},
                   .tip = "Say where the raw files lie now that the results on show were made of",
                   .run = [&app] { find_raw(app); },
                   .enabled =
                       [&app] {
                         const SurveyFiles* survey = app.workspace.document.survey();
                         return survey != nullptr && !survey->raw_gone.empty();
                       }});
  app.actions.add({.id = "file.demo",
                   .menu = kFile,
                   .text = "Demo survey",
                   .keys = {},
                   .tip = "Open a simulated survey; it is made first where it is not there yet",
                   .run = [&app] { open_demo(app); }});
  for (std::size_t i = 0; i < Preferences::kMostRecent; ++i) {
    app.actions.add({.id = fmt::format("file.recent.{}", i + 1),
                     .menu = "&File/Open &recent",
                     .text = "(none)",
                     .keys = {},
                     .tip = "Open this survey again",
                     .run =
                         [&app, i] {
                           if (i < app.preferences.recent.size()) {
                             app.workspace.document.open(app.preferences.recent[i]);
                           }
                         },
                     .enabled = [&app, i] { return i < app.preferences.recent.size(); },
                     .text_now = [&app, i] { return recent_text(app, i); }});
  }
}

void choose_calibration(AppModel& app) {
  if (!app.dialogs.file_to_open) return;
  const std::string file = app.dialogs.file_to_open("Calibration", kCalibrations);
  if (file.empty()) return;
  Document& document = app.workspace.document;
  document.run_beside([&document, file, recipe = document.recipe()](const CancelToken& token) {
    auto calibration = read_calibration(file, recipe);
    document.post(token, [&document, file, read = std::move(calibration)] {
      if (!read) return document.tell(to_line(read.error()));
      document.act(CalibrateCommand{*read, fs::path(file).filename().string()});
    });
  });
}

void change_recipe(AppModel& app) {
  Document& document = app.workspace.document;
  if (!app.dialogs.recipe) return;
  RecipeEditor editor(app.workspace.queue, document.recipe());
  {
    RecipeComparison comparison(app.workspace, editor);
    editor.show(&comparison);
    const bool used = app.dialogs.recipe(editor);
    editor.show(nullptr);
    if (!used) return;
  }
  if (app.live->on()) app.live->follow_next();
  document.use_recipe(editor.recipe());
  const std::size_t changed = editor.changed();
  document.tell(changed == 0
                    ? std::string("the recipe is the default one now")
                    : fmt::format("the recipe differs from the default one in {}", count_of(changed, "parameter")));
}

void take_recipe_back(AppModel& app) {
  if (app.live->on()) app.live->follow_next();
  app.workspace.document.use_recipe(Recipe(*app.workspace.document.recipe_before()));
}

void show_sphere_page(AppModel& app) {
  if (!app.dialogs.sphere) return;
  SpherePage page(app);
  app.dialogs.sphere(page);
}

void show_setup_page(AppModel& app) {
  if (!app.dialogs.setup) return;
  SetupPage page(app);
  app.dialogs.setup(page);
}

void add_calibration(AppModel& app) {
  const auto with_ping = [&app] { return app.workspace.document.shown() != nullptr; };
  app.actions.add({.id = "file.recipe",
                   .menu = kFile,
                   .text = "Recipe...",
                   .keys = {},
                   .tip = "Parameters of noise removal, detection and measuring: the survey is opened anew under them, "
                          "decisions stay",
                   .run = [&app] { change_recipe(app); },
                   .enabled =
                       [&app] {
                         const Document& document = app.workspace.document;
                         return !document.opening() || document.survey() == nullptr;
                       }});
  app.actions.add({.id = "file.recipe_before",
                   .menu = kFile,
                   .text = "Recipe before",
                   .keys = {},
                   .tip = "Open the survey under the recipe that it had before the last change of it; once more brings "
                          "the change back",
                   .run = [&app] { take_recipe_back(app); },
                   .enabled =
                       [&app] {
                         const Document& document = app.workspace.document;
                         return !document.opening() && document.recipe_before().has_value();
                       }});
  app.actions.add({.id = "file.setup_check",
                   .menu = kFile,
                   .text = "Setup check...",
                   .keys = {},
                   .tip = "Mounting angle and sound speed that the schools' mean speeds on each course leg ask for",
                   .run = [&app] { show_setup_page(app); },
                   .enabled = with_ping});
  app.actions.add({.id = "file.sphere",
                   .menu = kFile,
                   .text = "Calibrate by a sphere...",
                   .keys = {},
                   .tip = "Fit gain, Sa correction, psi and widths of each beam to a sphere run; write the table, or "
                          "measure with it",
                   .run = [&app] { show_sphere_page(app); }});
  app.actions.add(
      {.id = "file.calibration",
       .menu = kFile,
       .text = "Calibration...",
       .keys = {},
       .tip = "Measure with another calibration (a table channel,gain_db,..., or a recipe): masks and decisions "
              "stay",
       .run = [&app] { choose_calibration(app); },
       .enabled = with_ping});
  app.actions.add(
      {.id = "file.calibration_in_force",
       .menu = kFile,
       .text = "Calibration in force...",
       .keys = {},
       .tip = "Gain, Sa correction, equivalent beam angle and absorption of every beam, and where each comes from",
       .run =
           [&app] {
             CalibrationTable table(app.workspace);
             if (app.dialogs.rows) app.dialogs.rows("Calibration in force", table);
           },
       .enabled = with_ping});
  app.actions.add({.id = "file.own_calibration",
                   .menu = kFile,
                   .text = "Calibration of the recipe",
                   .keys = {},
                   .tip = "Go back to the calibration with which the journal began: masks and decisions stay",
                   .run =
                       [&app] {
                         Document& document = app.workspace.document;
                         document.act(CalibrateCommand{document.recipe().calibration, "of the recipe"});
                       },
                   .enabled = with_ping});
}

/// SURVEY-out, or SURVEY-out-2 and so on where a run has its results there; empty where nothing may be written.
fs::path proposed_folder(const Document& document, const std::string& ending) {
  if (document.paths().empty()) return {};
  return free_folder_beside(document.paths().front(), ending, [](const fs::path& folder) {
    std::error_code absent;
    return fs::exists(folder / "plan.json", absent);
  });
}

/// Asks for a folder and hands it on.
std::function<void()> into_folder(AppModel& app, std::string title, std::function<void(const fs::path&)> write,
                                  std::string ending = "-out") {
  return [&app, title = std::move(title), write = std::move(write), ending = std::move(ending)] {
    if (const std::string folder = asked_folder(app, title, ending); !folder.empty()) write(folder);
  };
}

std::string menu_text(std::string_view format) {
  if (format == "csv") return "Tables (CSV)...";
  if (format == "netcdf-mask") return "Masks (netCDF)...";
  if (format == "gpkg") return "Map (GeoPackage)...";
  if (format == "geojson") return "Map (GeoJSON)...";
  if (format == "seabed") return "Seabed (table and GeoTIFF)...";
  if (format == "raw-reduced") return "Reduced raw files...";
  if (format == "ply") return "Surfaces (PLY)...";
  if (format == "gltf") return "Surfaces (glTF)...";
  if (format == "vtu") return "Masks for ParaView (VTU)...";
  if (format == "vts") return "Sv for ParaView (VTS)...";
  if (format == "echoview") return "Regions for Echoview (EVR)...";
  if (format == "lsss") return "School masks for LSSS (XML)...";
  if (format == "avoidance") return "Vessel avoidance (table)...";
  if (format == "ices") return "Acoustic XML (ICES)...";
  return std::string(format) + "...";
}

void add_formats(AppModel& app) {
  Workspace& workspace = app.workspace;
  app.actions.add({.id = "export.results",
                   .menu = kExport,
                   .text = "Results...",
                   .keys = {"Ctrl+E"},
                   .tip = "Products, tables and map of the whole survey, as a run writes them",
                   .run = into_folder(app, "Folder for the results",
                                      [&workspace](const fs::path& folder) { export_results(workspace, folder); }),
                   .enabled = with_survey(app)});
  for (const ExportFormat& format : export_formats()) {
    const std::string name(format.name);
    app.actions.add({.id = "export." + name,
                     .menu = kExport,
                     .text = menu_text(name),
                     .keys = {},
                     .tip = std::string(format.text),
                     .run =
                         [&app, name,
                          into = into_folder(
                              app, "Folder for " + menu_text(name).substr(0, menu_text(name).size() - 3),
                              [&workspace, name](const fs::path& folder) { export_as(workspace, name, folder); },
                              name == "raw-reduced" ? "-reduced" : "-out")] {
                           if (name != "raw-reduced" || asked(app, "Reduced raw files", app.workspace.reduce)) into();
                         },
                     .enabled = with_survey(app)});
  }
}

}  // namespace

std::string asked_folder(AppModel& app, const std::string& title, const std::string& ending) {
  if (!app.dialogs.folder_to_save) return {};
  const fs::path proposed = proposed_folder(app.workspace.document, ending);
  // Dialogs choose only among folders that are there.
  std::error_code cannot;
  const bool made = !proposed.empty() && fs::create_directory(proposed, cannot);
  const bool there = made || (!proposed.empty() && fs::is_directory(proposed, cannot));
  std::string folder = app.dialogs.folder_to_save(title, there ? proposed.string() : std::string{});
  if (made && fs::path(folder) != proposed) fs::remove(proposed, cannot);  // it is empty, or stays
  return folder;
}

void add_exports(AppModel& app) {
  add_opening(app);
  add_calibration(app);
  add_batch(app);
  add_formats(app);
  add_pictures(app);
  app.actions.add({.id = "file.quit",
                   .menu = kFile,
                   .text = "Quit",
                   .keys = {"Ctrl+Q"},
                   .tip = "Everything that was decided is in the journal already",
                   .run = [&app] {
                     if (app.dialogs.quit) app.dialogs.quit();
                   }});
  app.listening.to(app.workspace.document.changes(), [&app](DocumentChange change) {
    const Document& document = app.workspace.document;
    if ((change == DocumentChange::looking || change == DocumentChange::ping) && document.shown()) {
      app.preferences.set_left_at(document.named(), document.shown()->name(), document.ping());
    }
    if (change != DocumentChange::survey || document.survey() == nullptr) return;
    app.preferences.remember(document.named());
    keep_preferences(app);
  });
}

void keep_preferences(AppModel& app) {
  if (app.preferences.path.empty()) return;
  app.preferences.take(app.workspace);
  const auto kept = app.preferences.save();
  if (kept) return;
  const std::string line = "preferences cannot be kept: " + to_line(kept.error());
  const auto& told = app.workspace.document.notices();
  if (std::find(told.begin(), told.end(), line) == told.end()) app.workspace.document.tell(line);
}

}  // namespace sonar
