// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/netcdf_file.h"
#include "model/product.h"

namespace sonar {

/// Reads the group /mask; pings and grid must be there already. Runs that do not fit them, overlap, or have other than
/// as many confidences are refused.
void read_mask(netcdf::Reader& in, ObservationProduct& product);

}  // namespace sonar
