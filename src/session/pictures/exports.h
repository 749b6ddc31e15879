// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "publish/picture_options.h"
#include "session/open/workspace.h"

namespace sonar {

// What goes out of the program. Everything runs behind the window, on what was there when it was asked for, and tells in
// one line what was written where, or why it was not. Nothing is ever written where raw files lie.

/// Products, tables and map of the survey as they are now, as a run would leave them, with the school numbers that the
/// window shows.
void export_results(Workspace& workspace, const std::filesystem::path& folder);
/// One of export_formats(), into a folder.
void export_as(Workspace& workspace, const std::string& format, const std::filesystem::path& folder);

/// How the window shows things, and what Workspace::picture_file asks for, as options of a picture.
/// errors  as with() of picture_file.h
[[nodiscard]] Result<PictureOptions> picture_options(const Workspace& workspace, PictureKind kind);
/// A picture of any kind, of the observation on show, as .png, .svg or .pdf.
void save_picture(Workspace& workspace, PictureKind kind, const std::filesystem::path& file);
/// A movie of pictures of that kind, as Workspace::picture_file asks for it: of the pings that are named there, else of the
/// selected school's, else of the observation on show. Into a folder, which is made: movie.mp4, or movie.png where there is
/// no ffmpeg.
void save_movie(Workspace& workspace, PictureKind kind, const std::filesystem::path& folder);

}  // namespace sonar
