// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "geo/frames.h"
#include "geo/sound_ray.h"

namespace sonar {

/// Where sound that bends in a profile comes from, and where a straight path would have it come from: the sonar says at
/// which elevation a beam leaves and after which time its echo returns, counted as slant range at one speed. The way runs
/// in the vertical plane of the beam. Worked out once from exact rays, 0.08 (level) to 2 degrees (upright) and a 256th of
/// the range apart, and between those evenly: within 0.1 m of the ray.
/// threads  immutable
class Refraction {
 public:
  /// profile             not empty
  /// transducer_depth_m  where rays begin; a heaving transducer takes them along
  /// sound_speed_mps     that ranges are counted at
  /// farthest_m          range up to which rays are followed
  Refraction(const SoundProfile& profile, double transducer_depth_m, double sound_speed_mps, double farthest_m);

  /// Of a place on the straight path, in a level frame with its origin at the transducer, the place on the ray; of one that
  /// is not known, none.
  [[nodiscard]] Point<Sonar> bent(const Point<Sonar>& straight) const;
  /// The other way. Where rays cross, the ray whose elevation is nearest to that of the straight path; where none comes, the
  /// one that passes nearest above or below.
  [[nodiscard]] Point<Sonar> straightened(const Point<Sonar>& bent) const;

 private:
  struct Offset {
    float distance_m = 0.0F;
    float down_m = 0.0F;
  };
  /// How far along the ray of a row a level distance lies, and by how much it runs too deep there.
  struct Miss {
    double range_m = 0.0;
    double down_m = 0.0;
  };
  [[nodiscard]] Miss miss(std::size_t row, double level_m, double down_m) const;
  /// Straightened by a look at all rays, where neighbouring ones part or cross so much that rounds lead nowhere.
  [[nodiscard]] Point<Sonar> searched(const Point<Sonar>& bent) const;

  double step_m_;
  std::vector<Offset> offsets_;  ///< [elevation, rising][range], of the ray from the straight path
};

}  // namespace sonar
