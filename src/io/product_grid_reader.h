// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/netcdf_file.h"
#include "model/product.h"

namespace sonar {

/// Reads the group /grid, which a product without beams has not. A grid that sectors and loops over voxels cannot rely on
/// is refused.
void read_grid(netcdf::Reader& in, ObservationProduct& product);
/// Reads the group /mask; pings and grid must be there already. Runs that do not fit them, overlap, or have other than
/// as many confidences are refused.
void read_mask(netcdf::Reader& in, ObservationProduct& product);

}  // namespace sonar
