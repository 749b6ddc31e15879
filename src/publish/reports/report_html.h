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

/// What write_report() writes, as one file of HTML 5 that needs nothing else, neither network nor script. The same survey
/// gives the same file.
/// errors  as write_report()
[[nodiscard]] Result<std::string> report_html(PictureSource& source, std::span<const std::filesystem::path> paths,
                                              const PictureOptions& options, Work& work);

}  // namespace sonar
