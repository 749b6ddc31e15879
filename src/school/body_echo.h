// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/frames.h"
#include "model/mask.h"
#include "school/mask_shape.h"
#include "school/measure_input.h"
#include "school/measure_params.h"
#include "school/vertical_fit.h"

namespace sonar {

/// What a ping's echo tells of a school's body before beam and pulse are taken out.
struct BodyEcho {
  bool known = false;                     ///< false = no echo above the background: nothing else means anything
  Covariance3 total{};                    ///< of the echo round its centre, sonar frame, m^2
  Covariance3 blur{};                     ///< what beam and pulse add to it, m^2
  Point<Sonar> centre;                    ///< m
  double mean_range2_m2 = 0;              ///< echo-weighted mean of range squared
  std::vector<HeightLikelihood> heights;  ///< [shape of the beam] as beam_shapes(); empty ones = too few fans to tell
};

/// The shapes of beam that a school's echo is held against, as shares of a Gaussian: BeamModel.
[[nodiscard]] std::vector<double> beam_shapes(const MeasureParams& params);

/// Second moments of the echo in and round the mask, and how likely which height of the body is.
/// The mask ends where the echo falls below its threshold, and moments cut there would be too small; so the echo is
/// taken from a wider stretch of water, where it dies away by itself.
[[nodiscard]] BodyEcho body_echo(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params);

}  // namespace sonar
