// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "model/navigation.h"

namespace sonar::synth {

/// What a ship's instruments say each second, checksummed: GGA, VTG, HDT, VLW, ZDA.
[[nodiscard]] std::vector<std::string> nmea_second(const PingNavigation& navigation);

}  // namespace sonar::synth
