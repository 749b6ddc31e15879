// SPDX-License-Identifier: Apache-2.0
// Pictures and movies out of the program.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>

#include "publish/picture_output.h"
#include "session/app_parts.h"
#include "session/figures/figure_model.h"
#include "session/pictures/exports.h"
#include "session/slices/slice_places.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "&File";
constexpr const char* kExport = "&File/&Export";
constexpr const char* kPictures = "&File/Save &picture";

std::function<bool()> with_survey(const AppModel& app) {
  return [&app] { return app.workspace.document.survey() != nullptr; };
}

/// "obs-0001-ping-0025-top_slice": pictures of many pings do not take each other's places.
std::string file_name(const AppModel& app, const std::string& what) {
  const Document& document = app.workspace.document;
  const bool of_survey = what.starts_with("survey") || what == "timeline" || what == "chart" || what == "report";
  if (!document.shown() || of_survey) return what;
  if (what.ends_with("echogram")) return document.shown()->name() + "-" + what;
  if (what.ends_with("map") || what.ends_with("timeline")) return document.shown()->name() + "-" + what;
  return fmt::format("{}-ping-{:04}-{}", document.shown()->name(), document.ping(), what);
}

void ask_for_picture(AppModel& app, PictureKind kind, const std::string& name) {
  if (!app.dialogs.file_to_save) return;
  Parameters<PictureFileParams>& params = app.workspace.picture_file;
  const PictureFileParams before = params.values();
  PictureFileParams begun = before;
  if (app.workspace.document.shown()) begun.kind = at_live_places(app.workspace, begun.kind);
  params.assign(begun);
  if (!asked(app, "Picture: " + name, params, asked_for(kind))) return params.assign(before);
  const char* ending = kind == PictureKind::report ? ".pdf" : ".png";
  const std::string file =
      app.dialogs.file_to_save("Save picture", "Pictures (*.png *.svg *.pdf)", file_name(app, name) + ending);
  if (!file.empty()) save_picture(app.workspace, kind, file);
}

void add_picture_kinds(AppModel& app) {
  for (std::size_t i = 0; i < picture_kinds().size(); ++i) {
    const PictureKindInfo& info = picture_kinds()[i];
    const auto kind = static_cast<PictureKind>(i);
    if (!is_one_picture(kind)) continue;
    app.actions.add({.id = "picture." + std::string(info.name),
                     .menu = kPictures,
                     .text = std::string(info.name) + "...",
                     .keys = {},
                     .tip = std::string(info.text),
                     .run = [&app, kind, name = std::string(info.name)] { ask_for_picture(app, kind, name); },
                     .enabled = with_survey(app)});
  }
}

void ask_for_movie(AppModel& app, PictureKind kind) {
  if (!app.dialogs.folder_to_save || !asked(app, "Movie", app.workspace.picture_file, asked_for(kind, true))) return;
  const std::string folder = asked_folder(app, "Folder for the movie", "-out");
  if (!folder.empty()) save_movie(app.workspace, kind, folder);
}

void add_movies(AppModel& app) {
  const auto add = [&app](const char* id, const char* text, PictureKind kind) {
    app.actions.add({.id = id,
                     .menu = kExport,
                     .text = text,
                     .keys = {},
                     .tip = "Over the pings of the selected school, or of the observation; a volume can also be "
                            "turned, or sailed past",
                     .run = [&app, kind] { ask_for_movie(app, kind); },
                     .enabled = with_survey(app)});
  };
  add("export.movie", "Movie of the school, from above...", PictureKind::slice_top);
  add("export.movie_side", "Movie of the school, from the side...", PictureKind::slice_side);
  add("export.movie_volume", "Movie of the school, in 3D...", PictureKind::volume);
  add("export.movie_map", "Movie of the school, on the map...", PictureKind::observation_map);
}

/// report.pdf in a folder beside the survey, as other exports.
void ask_for_report(AppModel& app) {
  const std::string folder = asked_folder(app, "Folder for the report", "-out");
  if (!folder.empty()) save_picture(app.workspace, PictureKind::report, fs::path(folder) / "report.pdf");
}

void add_report(AppModel& app) {
  app.actions.add({.id = "export.report",
                   .menu = kExport,
                   .text = "One-page report (PDF)...",
                   .keys = {},
                   .tip = "The survey on one page: map, timeline, strongest schools and what the numbers mean",
                   .run = [&app] { ask_for_report(app); },
                   .enabled = with_survey(app)});
}

/// The picture in use, where it has something to show.
const LivePicture* picture_in_use(AppModel& app) {
  const std::string id = app.dialogs.view_in_use ? app.dialogs.view_in_use() : std::string{};
  const LivePicture* picture = app.picture(id);
  if (picture != nullptr && !picture->image().pixels.empty()) return picture;
  app.workspace.document.tell("click the view whose picture you want");
  return nullptr;
}

void save_view(AppModel& app) {
  const LivePicture* picture = picture_in_use(app);
  if (picture == nullptr || !app.dialogs.file_to_save) return;
  const Image image = picture->image();
  const std::string file = app.dialogs.file_to_save("Save picture of view", "Pictures (*.png)",
                                                    file_name(app, app.dialogs.view_in_use()) + ".png");
  if (file.empty()) return;
  Document& document = app.workspace.document;
  if (document.survey() != nullptr) {
    if (auto outside = require_outside_raw(*document.survey(), fs::absolute(file).parent_path()); !outside) {
      return document.tell(to_line(outside.error()));
    }
  }
  document.run_beside([&document, image, file](const CancelToken& token) {
    const auto written = write_pixels(image, file);
    document.post(token,
                  [&document, line = written ? "written: " + file : to_line(written.error())] { document.tell(line); });
  });
}

void copy_view(AppModel& app) {
  const LivePicture* picture = picture_in_use(app);
  if (picture == nullptr || !app.dialogs.copy_image) return;
  app.dialogs.copy_image(picture->image());
  app.workspace.document.tell("the picture is in the clipboard");
}

void compose_figure(AppModel& app) {
  if (!app.dialogs.figure) return;
  FigureModel figure(app);
  app.dialogs.figure(figure);
  keep_preferences(app);
}

/// Words of one survey's figure are not another's.
void forget_words_of_figures(AppModel& app) {
  app.listening.to(app.workspace.document.changes(), [&app](DocumentChange change) {
    if (change != DocumentChange::survey) return;
    FigureParams params = app.workspace.figure.values();
    params.title.clear();
    params.caption.clear();
    app.workspace.figure.assign(params);
  });
}

}  // namespace

void add_pictures(AppModel& app) {
  add_movies(app);
  add_report(app);
  add_picture_kinds(app);
  app.actions.add({.id = "file.save_view",
                   .menu = kFile,
                   .text = "Save picture of view...",
                   .keys = {"Ctrl+S"},
                   .tip = "The view in use as it is on the screen",
                   .run = [&app] { save_view(app); },
                   .enabled = with_survey(app)});
  app.actions.add({.id = "file.copy_view",
                   .menu = kFile,
                   .text = "Copy picture of view",
                   .keys = {"Ctrl+Alt+C"},
                   .tip = "The view in use into the clipboard",
                   .run = [&app] { copy_view(app); },
                   .enabled = with_survey(app)});
  forget_words_of_figures(app);
  app.actions.add({.id = "file.figure",
                   .menu = kFile,
                   .text = "Figure for print...",
                   .keys = {"Ctrl+Shift+F"},
                   .tip = "Several views on a page, in millimetres and dpi, with one colour bar: PNG, SVG or PDF",
                   .run = [&app] { compose_figure(app); },
                   .enabled = with_survey(app)});
}

}  // namespace sonar
