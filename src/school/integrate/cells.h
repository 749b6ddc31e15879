// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sonar {

/// How water is cut into cells: bins of slant range from the transducer, channels of depth below the water line.
struct CellLayout {
  double range_bin_m = 50.0;
  double max_range_m = std::numeric_limits<double>::infinity();  ///< samples from here on are left out
  double depth_from_m = 0.0;                                     ///< top of channel 0
  double channel_m = 10.0;
  int max_channels = std::numeric_limits<int>::max();  ///< deeper ones are left out; 1 = the one layer and nothing else

  [[nodiscard]] bool is_layer() const { return max_channels == 1; }
  [[nodiscard]] double depth_m(int channel) const { return depth_from_m + channel * channel_m; }
};

/// Sums over the voxels of one cell, those that lie in it only partly by that part of their volume. What is not sound takes
/// no part but in water_m3.
struct CellSums {
  double water_m3 = 0.0;   ///< of voxels that hear water: neither near field, nor surface, nor seabed
  double heard_m3 = 0.0;   ///< of those, without faulty and missing samples
  double school_m3 = 0.0;  ///< of those, members of schools
  double echo_m2 = 0.0;    ///< sum of sv V, the expected background taken off
  double school_m2 = 0.0;  ///< of it, that of members
  double noise_m2 = 0.0;   ///< sum of the background's sv V
  double beam_m3 = 0.0;  ///< sum of V times the share of the beam that lies in the channel; NaN = widths are not known
  double variance_m4 = 0.0;      ///< of echo_m2 by fading
  double whole_m4 = 0.0;         ///< covariance of echo_m2 by fading with that of all the ping's channels
  double school_m4 = 0.0;        ///< as variance_m4, of school_m2
  double whole_school_m4 = 0.0;  ///< as whole_m4, of school_m2
  double noise_m4 = 0.0;         ///< variance that echo_m2 would have by the fading of the background alone
  // Of echo_m2, what schools had taken out of the beams and was given back; 0 where nothing is corrected.
  double extinction_m2 = 0.0;
  double extinction_low_m2 = 0.0;   ///< what it would be at the lower end of the ratio's interval
  double extinction_high_m2 = 0.0;  ///< at the upper one

  CellSums& operator+=(const CellSums& other);
  friend bool operator==(const CellSums&, const CellSums&) = default;
};

/// What one ping puts into the cells.
struct PingCells {
  int channels = 0;
  std::vector<CellSums> cells;  ///< [range bin][channel]
  std::vector<double> area_m2;  ///< [range bin]: horizontal area that the sector's ring spans

  [[nodiscard]] int bins() const { return static_cast<int>(area_m2.size()); }
  [[nodiscard]] const CellSums& at(int bin, int channel) const {
    return cells[static_cast<std::size_t>(bin) * static_cast<std::size_t>(channels) +
                 static_cast<std::size_t>(channel)];
  }
};

}  // namespace sonar
