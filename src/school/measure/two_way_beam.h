// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "model/beam_grid.h"
#include "school/measure/measure_params.h"

namespace sonar {

/// Solid angle of the two-way beams over that of beams which send as narrowly as they receive: 1 = as narrowly, up to
/// 2.25 where the transmit beam is wide both ways. From the sounder's equivalent beam angles, one number for all beams.
/// psi_db  [fan][beam] equivalent two-way beam angle, dB re 1 sr
/// params  beam_angle_*
/// out     1 where the angles say nothing: missing, out of what any transmit beam could make of the -3 dB widths, or of
///         another pattern over the beams than the widths (copied from one beam to all, say). A transmit beam for a whole
///         fan ripples, and so do the angles from beam to beam: what is judged is a surface of second degree over them.
[[nodiscard]] double two_way_area(const BeamGrid& grid, std::span<const double> psi_db, const MeasureParams& params);

/// One shape of beam that a school's echo is held against.
struct BeamShape {
  double gaussian_share = 0.5;    ///< BeamModel's
  double transmit_ratio = 1.0;    ///< BeamModel's, across the fans
  double upright_variance = 1.0;  ///< of the vertical two-way beam, over that of one that sends as narrowly
  double level_variance = 1.0;    ///< of the horizontal one
  double handicap = 0.0;          ///< log-likelihood by which it must outdo a shape that has none
};

/// The shapes of beam to choose among. A wider transmit beam is taken to be sent all along the fan, as of a sonar that sends
/// for all beams of a fan at once; where the area is smaller than that makes it, it is narrower upright, as of an array that
/// is shaded for receiving alone. Or it is wider both ways alike, where schools' heights say so clearly: they hardly tell a
/// narrow beam and a high body from a wide beam and a low one.
/// area  two_way_area()'s
[[nodiscard]] std::vector<BeamShape> beam_shapes(const MeasureParams& params, double area);

}  // namespace sonar
