// SPDX-License-Identifier: Apache-2.0
#include "model/navigation.h"

#include <cmath>

#include "base/units.h"

namespace sonar {

Placement PingNavigation::placement() const {
  return {transducer, std::isnan(heading_deg) ? 0.0 : rad_from_deg(heading_deg), transducer_depth_m};
}

}  // namespace sonar
