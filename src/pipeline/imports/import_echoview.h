// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/result.h"
#include "pipeline/imports/import.h"

namespace sonar {

/// Regions of Echoview (.evr). Their times are matched to the pings, their depth is the slant range of a fan's samples, as in
/// what export --to echoview writes. Regions of type 1 (analysis) and 3 (fish track) are schools in the fan and beams that their
/// notes name, else `place`: the samples inside the polygon. Where notes tell the cells of a ping (cells_of()), those of them
/// inside the polygon, and all of the polygon nearer or farther than any of them; regions whose notes do so and that have one
/// name are one school, of several files too. Markers (2) are marks; bad data (0) over the whole range, bad pings.
/// errors  format, unsupported: as parse_evr(), cells_of(); usage: no fan is named, or one that is not there; cancelled
[[nodiscard]] Result<void> import_evr(const std::string& text, const std::string& file, const ImportPlace& place,
                                      Imported& imported, const Work& work);

}  // namespace sonar
