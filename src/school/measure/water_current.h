// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/describe.h"
#include "model/current.h"
#include "model/school.h"
#include "school/measure/centre_track.h"
#include "school/measure/line_fit.h"

namespace sonar {

/// How far from a profile its water velocity is taken to hold.
struct CurrentParams {
  double max_gap_s = 900.0;
  double max_depth_gap_m = 20.0;
  double max_distance_m = 5000.0;
};

template <class Visitor>
void describe(Visitor& v, CurrentParams& p) {
  v.field("max_gap_s", p.max_gap_s,
          {.unit = "s",
           .min = 0,
           .max = 1e6,
           .text = "The water's velocity at a school is told by profiles no farther in time than this, between two of "
                   "them linearly; raise it where profiles are rare and the current is steady."});
  v.field("max_depth_gap_m", p.max_depth_gap_m,
          {.unit = "m",
           .min = 0,
           .max = 1000,
           .text = "A school has a velocity through the water only if a depth at which the current is told lies within "
                   "this of it; above the first and below the last that one holds. Raise it where the current profiler "
                   "begins deep and the water above is mixed."});
  v.field("max_distance_m", p.max_distance_m,
          {.unit = "m",
           .min = 0,
           .max = 1e6,
           .text = "The water's velocity at a school is told by profiles no farther away than this, where they tell "
                   "their place; raise it for a mooring in an even current."});
}

/// Water velocities, and how they are used.
struct WaterCurrents {
  const CurrentProfiles* profiles = nullptr;
  CurrentParams params;
  double noise_mps = kUnknown;  ///< standard error of a profile's velocity, each way: current_noise_mps()
};

/// What a velocity is made of: profiles, and their shares, which sum up to 1.
struct CurrentHere {
  double east_mps = 0.0;
  double north_mps = 0.0;
  std::size_t before = 0;  ///< profile
  std::size_t after = 0;   ///< profile; that before where it alone counts
  double share_of_after = 0.0;
};

/// Linear in time between the last profile before and the first after that tell of the depth and lie within max_gap_s and
/// max_distance_m; where there is but one, that. Empty where there is none.
[[nodiscard]] std::optional<CurrentHere> current_at(const CurrentProfiles& profiles, TimeNs time,
                                                    const Geographic& place, double depth_m,
                                                    const CurrentParams& params);

/// Standard error of one profile's velocity, each way: by how much profiles differ from what those before and after them
/// tell of the same depth. It has the noise of the instrument and what changes from profile to profile, not the errors
/// that all have alike (a transducer turned in its well, a wrong gain). Unknown where no three
/// profiles follow one another.
/// source  the variance of a difference of three independent values, 1 + w^2 + (1 - w)^2
[[nodiscard]] double current_noise_mps(const CurrentProfiles& profiles, const CurrentParams& params);

/// The current along a part of a school's track.
struct CurrentAlong {
  LineFit drift;  ///< slope: as a line through drifted places has it; variances by the profiles' noise, where known
  double east_mps = 0.0;  ///< means over the places
  double north_mps = 0.0;
  double error_mps = kUnknown;  ///< standard error of these means, each way
};

/// Velocities at the places of a track, and how far the water has drifted since the first.
class DriftedWater {
 public:
  /// t  [n] rising; here [n]
  DriftedWater(std::vector<double> t, std::vector<CurrentHere> here, double noise_mps);
  /// first, last  of places [first, last), at least two
  [[nodiscard]] CurrentAlong along(std::size_t first, std::size_t last) const;

 private:
  std::vector<double> t_;
  std::vector<CurrentHere> here_;
  std::vector<double> east_m_;
  std::vector<double> north_m_;
  double noise_mps_;
};

/// Along a school's track; empty where the current is unknown at one of its places.
[[nodiscard]] std::optional<DriftedWater> drifted_water(const CentreTrack& track, std::span<const SchoolPingRow> rows,
                                                        const WaterCurrents& water);

/// The line of a school's way through the water: that over ground less the drift, of independent errors.
[[nodiscard]] LineFit through_water(const LineFit& over_ground, const LineFit& drift);
/// Its speed; that alone where the error of the current is unknown.
[[nodiscard]] Speed speed_through_water(const LineFit& over_ground, const CurrentAlong& current);

}  // namespace sonar
