// SPDX-License-Identifier: Apache-2.0
// What is opened, and what goes out of the program.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "pipeline/calibration_json.h"
#include "pipeline/export.h"
#include "publish/picture_files.h"
#include "session/desk_parts.h"
#include "session/exports.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "&File";
constexpr const char* kCalibrations = "Calibrations and recipes (*.csv *.json *.CSV *.JSON);;All files (*)";
constexpr const char* kExport = "&File/&Export";
constexpr const char* kPictures = "&File/Save &picture";

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
  auto calibration = read_calibration(file, document.recipe());
  if (!calibration) return document.tell(to_line(calibration.error()));
  document.act(CalibrateCommand{std::move(*calibration), fs::path(file).filename().string()});
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
         .run = into_folder(desk, "Folder for " + menu_text(name).substr(0, menu_text(name).size() - 3),
                            [&workspace, name](const fs::path& folder) { export_as(workspace, name, folder); }),
         .enabled = with_survey(desk)});
  }
  desk.actions.add({.id = "export.movie",
                    .menu = kExport,
                    .text = "Movie of the school, from above...",
                    .keys = {},
                    .tip = "One picture a ping of the selected school's track, and one that plays them",
                    .run = into_folder(desk, "Folder for the movie",
                                       [&workspace](const fs::path& folder) {
                                         save_movie(workspace, PictureKind::slice_top, folder);
                                       }),
                    .enabled = with_survey(desk)});
  desk.actions.add(
      {.id = "export.movie_volume",
       .menu = kExport,
       .text = "Movie of the school, three dimensions...",
       .keys = {},
       .tip = "One picture a ping of the selected school's track, and one that plays them",
       .run = into_folder(desk, "Folder for the movie",
                          [&workspace](const fs::path& folder) { save_movie(workspace, PictureKind::volume, folder); }),
       .enabled = with_survey(desk)});
}

/// Asks for a number; empty where the human declined, or gave none.
std::optional<double> asked_number(Desk& desk, const std::string& label, double first) {
  if (!desk.asking.text) return std::nullopt;
  const std::string text = desk.asking.text("Save picture", label, fmt::format("{:.0f}", first)).value_or("");
  double value = 0.0;
  const auto [after, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (!text.empty() && problem == std::errc() && after == text.data() + text.size()) return value;
  if (!text.empty()) desk.workspace.document.tell(fmt::format("{}: expected a number, not \"{}\"", label, text));
  return std::nullopt;
}

void ask_for_picture(Desk& desk, PictureKind kind, const std::string& name) {
  PictureOptions options = picture_options(desk.workspace);
  if (kind == PictureKind::slice_range) {
    options.range_m = asked_number(desk, "Slant range, m", 200.0);
    if (!options.range_m) return;
  }
  if (kind == PictureKind::slice_plane) {
    options.plane.depth_m = asked_number(desk, "Depth below the sea surface, m", 50.0);
    if (!options.plane.depth_m) return;
  }
  if (!desk.asking.file_to_save) return;
  const std::string file = desk.asking.file_to_save("Save picture", "Pictures (*.png *.svg *.pdf)", name + ".png");
  if (!file.empty()) save_picture(desk.workspace, kind, std::move(options), file);
}

void add_picture_kinds(Desk& desk) {
  for (std::size_t i = 0; i < picture_kinds().size(); ++i) {
    const PictureKindInfo& info = picture_kinds()[i];
    const auto kind = static_cast<PictureKind>(i);
    desk.actions.add({.id = "picture." + std::string(info.name),
                      .menu = kPictures,
                      .text = std::string(info.name) + "...",
                      .keys = {},
                      .tip = std::string(info.text),
                      .run = [&desk, kind, name = std::string(info.name)] { ask_for_picture(desk, kind, name); },
                      .enabled = with_survey(desk)});
  }
}

/// The picture in use, where it has something to show.
const LivePicture* picture_in_use(Desk& desk) {
  const std::string id = desk.asking.view_in_use ? desk.asking.view_in_use() : std::string{};
  const LivePicture* picture = desk.picture(id);
  if (picture != nullptr && !picture->image().pixels.empty()) return picture;
  desk.workspace.document.tell("click into the view whose picture is wanted");
  return nullptr;
}

void save_view(Desk& desk) {
  const LivePicture* picture = picture_in_use(desk);
  if (picture == nullptr || !desk.asking.file_to_save) return;
  const Image image = picture->image();
  const std::string file =
      desk.asking.file_to_save("Save picture of view", "Pictures (*.png)", desk.asking.view_in_use() + ".png");
  if (file.empty()) return;
  Document& document = desk.workspace.document;
  if (document.survey() != nullptr) {
    if (auto outside = require_outside_raw(*document.survey(), fs::absolute(file).parent_path()); !outside) {
      return document.tell(to_line(outside.error()));
    }
  }
  const auto written = write_pixels(image, file);
  document.tell(written ? "written: " + file : to_line(written.error()));
}

void copy_view(Desk& desk) {
  const LivePicture* picture = picture_in_use(desk);
  if (picture == nullptr || !desk.asking.copy_image) return;
  desk.asking.copy_image(picture->image());
  desk.workspace.document.tell("the picture is in the clipboard");
}

}  // namespace

void add_exports(Desk& desk) {
  add_opening(desk);
  add_calibration(desk);
  add_formats(desk);
  add_picture_kinds(desk);
  desk.actions.add({.id = "file.save_view",
                    .menu = kFile,
                    .text = "Save picture of view...",
                    .keys = {"Ctrl+S"},
                    .tip = "The view in use as it is on the screen",
                    .run = [&desk] { save_view(desk); }});
  desk.actions.add({.id = "file.copy_view",
                    .menu = kFile,
                    .text = "Copy picture of view",
                    .keys = {"Ctrl+Alt+C"},
                    .tip = "The view in use into the clipboard",
                    .run = [&desk] { copy_view(desk); }});
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
