// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "base/work.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"

namespace sonar {

/// Whether the ending is .html or .htm, in any case of letters.
[[nodiscard]] bool is_report_html(const std::filesystem::path& file);

/// The whole report of a survey as one file of HTML 5 that needs nothing else, neither network nor script: what it is, map,
/// timeline, charts and strongest schools as pictures, every column of the schools with their uncertainties, the tables of
/// echo integration, the recipe, the raw files, what was noted, and what the columns mean. Without raw files it lacks the
/// pictures of samples. Times are the data's: the same survey gives the same file.
/// paths    those that the source was opened with; a work folder's effort.csv, nasc.csv and strata.csv are shown
/// options  as report_page()
/// errors   cancelled; format: a table that is none
[[nodiscard]] Result<std::string> report_html(PictureSource& source, std::span<const std::filesystem::path> paths,
                                              const PictureOptions& options, Work& work);

}  // namespace sonar
