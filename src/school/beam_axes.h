// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "geo/sector.h"

namespace sonar {

/// Directions of many beams, row by row: beam_axis() to the last bit, with the sines of an azimuth and of a fan worked out
/// once.
/// threads  one object belongs to one thread
class BeamAxes {
 public:
  explicit BeamAxes(const Sector& sector) : sector_(sector) {
    for (int beam = 0; beam < sector.beams(); ++beam) {
      ahead_.push_back({std::cos(sector.azimuth_rad(beam)), std::sin(sector.azimuth_rad(beam))});
    }
  }

  [[nodiscard]] Point<Sonar> of(int row, double lower_by_rad = 0.0) const {
    const double elevation = std::max(sector_.elevation_rad(row / sector_.beams()) - lower_by_rad, kSteepest_rad);
    if (elevation != elevation_rad_) {
      elevation_rad_ = elevation;
      level_ = std::cos(elevation);
      down_ = -std::sin(elevation);
    }
    const Ahead& ahead = ahead_[static_cast<std::size_t>(row % sector_.beams())];
    return {level_ * ahead.cosine, level_ * ahead.sine, down_};
  }

 private:
  static constexpr double kSteepest_rad = -1.57;
  struct Ahead {
    double cosine = 0.0;
    double sine = 0.0;
  };
  const Sector& sector_;
  std::vector<Ahead> ahead_;  ///< [beam]
  mutable double elevation_rad_ = std::numeric_limits<double>::quiet_NaN();
  mutable double level_ = 0.0;
  mutable double down_ = 0.0;
};

}  // namespace sonar
