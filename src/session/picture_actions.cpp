// SPDX-License-Identifier: Apache-2.0
// Pictures and movies out of the program.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>

#include "publish/picture_files.h"
#include "session/desk_parts.h"
#include "session/exports.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "&File";
constexpr const char* kExport = "&File/&Export";
constexpr const char* kPictures = "&File/Save &picture";

std::function<bool()> with_survey(const Desk& desk) {
  return [&desk] { return desk.workspace.document.survey() != nullptr; };
}

/// "obs-0001-ping-0025-top_slice": pictures of many pings do not take each other's places.
std::string file_name(const Desk& desk, const std::string& what) {
  const Document& document = desk.workspace.document;
  if (!document.shown() || what.starts_with("survey") || what == "timeline") return what;
  if (what.ends_with("map") || what.ends_with("timeline")) return document.shown()->name() + "-" + what;
  return fmt::format("{}-ping-{:04}-{}", document.shown()->name(), document.ping(), what);
}

void ask_for_picture(Desk& desk, PictureKind kind, const std::string& name) {
  if (!desk.asking.file_to_save || !asked(desk, "Picture: " + name, desk.workspace.picture_file, asked_for(kind))) {
    return;
  }
  const std::string file =
      desk.asking.file_to_save("Save picture", "Pictures (*.png *.svg *.pdf)", file_name(desk, name) + ".png");
  if (!file.empty()) save_picture(desk.workspace, kind, file);
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

void ask_for_movie(Desk& desk, PictureKind kind) {
  if (!desk.asking.folder_to_save || !asked(desk, "Movie", desk.workspace.picture_file, asked_for_movie(kind))) return;
  const std::string folder = desk.asking.folder_to_save("Folder for the movie");
  if (!folder.empty()) save_movie(desk.workspace, kind, folder);
}

void add_movies(Desk& desk) {
  const auto add = [&desk](const char* id, const char* text, PictureKind kind) {
    desk.actions.add({.id = id,
                      .menu = kExport,
                      .text = text,
                      .keys = {},
                      .tip = "One picture a ping of the selected school's track, and one that plays them",
                      .run = [&desk, kind] { ask_for_movie(desk, kind); },
                      .enabled = with_survey(desk)});
  };
  add("export.movie", "Movie of the school, from above...", PictureKind::slice_top);
  add("export.movie_side", "Movie of the school, from the side...", PictureKind::slice_side);
  add("export.movie_volume", "Movie of the school, three dimensions...", PictureKind::volume);
  add("export.movie_map", "Movie of the school, on the map...", PictureKind::observation_map);
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
  const std::string file = desk.asking.file_to_save("Save picture of view", "Pictures (*.png)",
                                                    file_name(desk, desk.asking.view_in_use()) + ".png");
  if (file.empty()) return;
  Document& document = desk.workspace.document;
  if (document.survey() != nullptr) {
    if (auto outside = require_outside_raw(*document.survey(), fs::absolute(file).parent_path()); !outside) {
      return document.tell(to_line(outside.error()));
    }
  }
  document.run_beside([&document, image, file](const Wanted& wanted) {
    const auto written = write_pixels(image, file);
    document.post(wanted,
                  [&document, line = written ? "written: " + file : to_line(written.error())] { document.tell(line); });
  });
}

void copy_view(Desk& desk) {
  const LivePicture* picture = picture_in_use(desk);
  if (picture == nullptr || !desk.asking.copy_image) return;
  desk.asking.copy_image(picture->image());
  desk.workspace.document.tell("the picture is in the clipboard");
}

}  // namespace

void add_pictures(Desk& desk) {
  add_movies(desk);
  add_picture_kinds(desk);
  desk.actions.add({.id = "file.save_view",
                    .menu = kFile,
                    .text = "Save picture of view...",
                    .keys = {"Ctrl+S"},
                    .tip = "The view in use as it is on the screen",
                    .run = [&desk] { save_view(desk); },
                    .enabled = with_survey(desk)});
  desk.actions.add({.id = "file.copy_view",
                    .menu = kFile,
                    .text = "Copy picture of view",
                    .keys = {"Ctrl+Alt+C"},
                    .tip = "The view in use into the clipboard",
                    .run = [&desk] { copy_view(desk); },
                    .enabled = with_survey(desk)});
}

}  // namespace sonar
