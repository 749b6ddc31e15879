// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "base/result.h"
#include "base/work.h"
#include "model/product.h"

namespace sonar {

/// Writes an observation's masks as whole arrays, for programs that know nothing of runs: netCDF-4 with
/// school_id(ping, fan, beam, sample) (0 = none) and confidence (0..255) of the same shape, and the coordinates time,
/// elevation, azimuth and range. Pings without schools take no room. A product without a grid gives pings alone.
/// errors  io, no_space, bad_parameter (a school_id beyond 2^31, a mask that does not fit)
Result<void> write_mask_volume(const ObservationProduct& product, const std::filesystem::path& path, const Work& work);

}  // namespace sonar
