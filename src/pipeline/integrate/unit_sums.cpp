// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/unit_sums.h"

#include <cstddef>

namespace sonar {

void UnitSums::add(const PingCells& ping) {
  ++pings;
  for (int bin = 0; bin < ping.bins(); ++bin) {
    const double area = ping.area_m2[static_cast<std::size_t>(bin)];
    if (!(area > 0.0)) continue;
    area_m2[bin] += area;
    for (int channel = 0; channel < ping.channels; ++channel) {
      const CellSums& cell = ping.at(bin, channel);
      if (cell.water_m3 > 0.0) cells[{bin, channel}] += cell;
    }
  }
}

}  // namespace sonar
