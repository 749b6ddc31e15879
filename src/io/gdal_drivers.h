// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace sonar {

/// Registers the drivers that we use, and no other: some fetch from networks, run what a file says, or are loaded from a
/// folder that the environment names. What lies beside a file (.aux.xml, .ovr, .msk; not the .prj of an ASCII grid) is neither read nor
/// written.
/// threads  any
void begin_gdal();

}  // namespace sonar
