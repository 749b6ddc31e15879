// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model/fish_lengths.h"
#include "model/school.h"
#include "model/ts_relation.h"

namespace sonar {

/// How a school lies to the beam. NaN = unknown.
struct BeamToSchool {
  double bearing_deg = kUnknown;    ///< of the school from the transducer, true
  double elevation_deg = kUnknown;  ///< of the school from the transducer, positive up
  double course_deg = kUnknown;     ///< of the school, true
};

/// Angle between the beam and the school's course: 0 end on, from ahead or from behind, 90 broadside. Unknown where any part
/// is. (incidence_deg of the school tables is the same angle to the school's length.)
[[nodiscard]] double aspect_deg(const BeamToSchool& look);

/// Backscattering cross-section of a fish, the linear mean over lengths and over how the fish of a school stand.
class MeanStrength {
 public:
  /// wave_number  2 pi f / c, m^-1; used where the relation has a directivity
  MeanStrength(const TsRelation& relation, const FishLengths& lengths, double wave_number);
  /// m^2. Where the course is not known fish of any heading are meant, and level beams where the elevation is not. A
  /// depth that is not known makes the result unknown where it counts.
  [[nodiscard]] double sigma_bs_m2(double depth_m, const BeamToSchool& look) const;

 private:
  [[nodiscard]] double along(double cosine) const;
  [[nodiscard]] double over_headings(double relative_rad, double elevation_rad) const;

  TsRelation relation_;
  double at_surface_m2_ = 0.0;  ///< mean over lengths, broadside
  std::vector<double> table_;   ///< mean over lengths by the cosine between a fish's axis and the beam, 0 .. 1
};

}  // namespace sonar
