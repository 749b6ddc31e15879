// SPDX-License-Identifier: Apache-2.0
// What is opened, and what goes out of the program.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "pipeline/exports/export.h"
#include "pipeline/survey/calibration_json.h"
#include "session/desk_parts.h"
#include "session/exports.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "&File";
constexpr const char* kCalibrations = "Calibrations and recipes (*.csv *.json *.CSV *.JSON);;All files (*)";
constexpr const char* kExport = "&File/&Export";

std::function<bool()> with_survey(const Desk& desk) {
  return [&desk] { return desk.workspace.document.survey() != nullptr; };
}

void open_folder(Desk& desk) {
  if (!desk.asking.folder_to_open) return;
  if (const std::string folder = desk.asking.folder_to_open(); !folder.empty()) desk.workspace.document.open({folder});
}

void open_files(Desk& desk) {
  if (!desk.asking.files_to_open) return;
  const auto names = desk.asking.files_to_open();
  if (!names.empty()) desk.workspace.document.open({names.begin(), names.end()});
}

std::string recent_text(const Desk& desk, std::size_t at) {
  if (at >= desk.preferences.recent.size()) return {};
  const auto& paths = desk.preferences.recent[at];
  const std::string first = paths.front().string();
  return paths.size() == 1 ? first : fmt::format("{} and {} more", first, paths.size() - 1);
}

void add_opening(Desk& desk) {
  desk.actions.add({.id = "file.open_folder",
                    .menu = kFile,
                    .text = "Open folder...",
                    .keys = {"Ctrl+O"},
                    .tip = "Open a folder of raw files as a survey",
                    .run = [&desk] { open_folder(desk); }});
  desk.actions.add({.id = "file.open_files",
                    .menu = kFile,
                    .text = "Open files...",
                    .keys = {"Ctrl+Shift+O"},
                    .tip = "Open some raw files as a survey",
                    .run = [&desk] { open_files(desk); }});
  for (std::size_t i = 0; i < Preferences::kMostRecent; ++i) {
    desk.actions.add({.id = fmt::format("file.recent.{}", i + 1),
                      .menu = "&File/Open &recent",
                      .text = "(none)",
                      .keys = {},
                      .tip = "Open this survey again",
                      .run =
                          [&desk, i] {
                            if (i < desk.preferences.recent.size()) {
                              desk.workspace.document.open(desk.preferences.recent[i]);
                            }
                          },
                      .enabled = [&desk, i] { return i < desk.preferences.recent.size(); },
                      .text_now = [&desk, i] { return recent_text(desk, i); }});
  }
}

void choose_calibration(Desk& desk) {
  if (!desk.asking.file_to_open) return;
  const std::string file = desk.asking.file_to_open("Calibration", kCalibrations);
  if (file.empty()) return;
  Document& document = desk.workspace.document;
  document.run_beside([&document, file, recipe = document.recipe()](const Wanted& wanted) {
    auto calibration = read_calibration(file, recipe);
    document.post(wanted, [&document, file, read = std::move(calibration)] {
      if (!read) return document.tell(to_line(read.error()));
      document.act(CalibrateCommand{*read, fs::path(file).filename().string()});
    });
  });
}

void add_calibration(Desk& desk) {
  const auto with_ping = [&desk] { return desk.workspace.document.shown() != nullptr; };
  desk.actions.add(
      {.id = "file.calibration",
       .menu = kFile,
       .text = "Calibration...",
       .keys = {},
       .tip = "Measure under another calibration (a table channel,gain_db,..., or a recipe): masks and decisions "
              "stay",
       .run = [&desk] { choose_calibration(desk); },
       .enabled = with_ping});
  desk.actions.add({.id = "file.own_calibration",
                    .menu = kFile,
                    .text = "Calibration of the recipe",
                    .keys = {},
                    .tip = "Measure again as the journal began: masks and decisions stay",
                    .run =
                        [&desk] {
                          Document& document = desk.workspace.document;
                          document.act(CalibrateCommand{document.recipe().calibration, "of the recipe"});
                        },
                    .enabled = with_ping});
}

/// Asks for a folder and hands it on.
std::function<void()> into_folder(Desk& desk, std::string title, std::function<void(const fs::path&)> write) {
  return [&desk, title = std::move(title), write = std::move(write)] {
    if (!desk.asking.folder_to_save) return;
    if (const std::string folder = desk.asking.folder_to_save(title); !folder.empty()) write(folder);
  };
}

std::string menu_text(std::string_view format) {
  if (format == "csv") return "Tables (CSV)...";
  if (format == "netcdf-mask") return "Masks (netCDF)...";
  if (format == "gpkg") return "Map (GeoPackage)...";
  if (format == "geojson") return "Map (GeoJSON)...";
  if (format == "raw-reduced") return "Reduced raw files...";
  return std::string(format) + "...";
}

void add_formats(Desk& desk) {
  Workspace& workspace = desk.workspace;
  desk.actions.add({.id = "export.results",
                    .menu = kExport,
                    .text = "Results...",
                    .keys = {"Ctrl+E"},
                    .tip = "Products, tables and map of the whole survey, as a run writes them",
                    .run = into_folder(desk, "Folder for the results",
                                       [&workspace](const fs::path& folder) { export_results(workspace, folder); }),
                    .enabled = with_survey(desk)});
  for (const ExportFormat& format : export_formats()) {
    const std::string name(format.name);
    desk.actions.add(
        {.id = "export." + name,
         .menu = kExport,
         .text = menu_text(name),
         .keys = {},
         .tip = std::string(format.text),
         .run =
             [&desk, name,
              into = into_folder(desk, "Folder for " + menu_text(name).substr(0, menu_text(name).size() - 3),
                                 [&workspace, name](const fs::path& folder) { export_as(workspace, name, folder); })] {
               if (name != "raw-reduced" || asked(desk, "Reduced raw files", desk.workspace.reduce)) into();
             },
         .enabled = with_survey(desk)});
  }
}

}  // namespace

void add_exports(Desk& desk) {
  add_opening(desk);
  add_calibration(desk);
  add_formats(desk);
  add_pictures(desk);
  desk.actions.add({.id = "file.quit",
                    .menu = kFile,
                    .text = "Quit",
                    .keys = {"Ctrl+Q"},
                    .tip = "Everything that was decided is in the journal already",
                    .run = [&desk] {
                      if (desk.asking.quit) desk.asking.quit();
                    }});
  desk.workspace.document.changes().add([&desk](DocumentChange change) {
    if (change != DocumentChange::survey || desk.workspace.document.survey() == nullptr) return;
    desk.preferences.remember(desk.workspace.document.paths());
    keep_preferences(desk);
  });
}

void keep_preferences(Desk& desk) {
  if (desk.preferences.path.empty()) return;
  desk.preferences.take(desk.workspace);
  const auto kept = desk.preferences.save();
  if (kept) return;
  const std::string line = "preferences cannot be kept: " + to_line(kept.error());
  const auto& told = desk.workspace.document.notices();
  if (std::find(told.begin(), told.end(), line) == told.end()) desk.workspace.document.tell(line);
}

}  // namespace sonar
