// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "model/school.h"
#include "school/measure/body_echo.h"
#include "school/measure/density_profile.h"
#include "school/measure/measure_params.h"
#include "school/measure/two_way_beam.h"

namespace sonar {

/// A school's body by the echo of one ping, the sonar's blur taken out, before it is known how its density changes.
struct BodySighting {
  double length_variance = 0.0;  ///< of the body, m^2
  double width_variance = 0.0;
  double height_variance = kUnknown;
  double blur_variance = 0.0;    ///< of beam and pulse, level
  double length_axis_rad = 0.0;  ///< of the length, from the bow towards starboard
  AxisSighting length;           ///< how its density changes
  AxisSighting width;
  AxisSighting line_of_sight;  ///< along it, where the sonar sees most sharply: so it is taken to change upright
};

/// The echo's second and fourth moments less those of beam and pulse.
/// heights  how likely which height is, by this ping alone or with its neighbours
/// beam     the shape for which the heights are that likely
/// out      none where there is no echo
[[nodiscard]] std::optional<BodySighting> body_sighting(const BodyEcho& echo, const HeightLikelihood& heights,
                                                        const BeamShape& beam, const MeasureParams& params);

/// Extents; NaN = the blur is all that is seen.
struct BodySize {
  double length_m = kUnknown;
  double width_m = kUnknown;
  double height_m = kUnknown;
  double incidence_deg = kUnknown;  ///< between the beam and the length, 0 = end on, 90 = broadside
};

/// Squares of half axes over the variances along them, by density_profile.h.
struct BodyShape {
  double length = 5.0;
  double width = 5.0;
  double height = 5.0;
};

/// centre  of the body, sonar frame
[[nodiscard]] BodySize body_size(const BodySighting& body, const BodyShape& shape, const Point<Sonar>& centre,
                                 const MeasureParams& params);

}  // namespace sonar
