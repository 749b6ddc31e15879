// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/result.h"
#include "pipeline/imports/import.h"

namespace sonar {

/// School masks of LSSS (.work): each school is one in every observation that has pings of it, with the species of the largest
/// share. Channels and samples count as `place.lsss` says, or else the file.
/// errors  format, unsupported: as parse_lsss_work(); mismatch: as place_lsss(); cancelled
[[nodiscard]] Result<void> import_lsss(const std::string& text, const std::string& file, const ImportPlace& place,
                                       Imported& imported, const Work& work);

}  // namespace sonar
