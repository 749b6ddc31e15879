// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/school.h"
#include "school/body_echo.h"
#include "school/measure_params.h"
#include "school/two_way_beam.h"

namespace sonar {

/// A school's body with the sonar's blur taken out; NaN = the blur is all that is seen.
struct BodySize {
  double length_m = kUnknown;
  double width_m = kUnknown;
  double height_m = kUnknown;
};

/// The extents of an ellipsoid of the echo's second moments less those of beam and pulse.
/// heights  how likely which height is, by this ping alone or with its neighbours
/// beam     the shape for which the heights are that likely
/// shape_variance  square of a half axis over the variance along it: density_profile.h
[[nodiscard]] BodySize body_size(const BodyEcho& echo, const HeightLikelihood& heights, const BeamShape& beam,
                                 double shape_variance, const MeasureParams& params);

}  // namespace sonar
