// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/frames.h"
#include "model/mask.h"
#include "school/mask_shape.h"
#include "school/measure/density_profile.h"
#include "school/measure/measure_input.h"
#include "school/measure/measure_params.h"
#include "school/measure/vertical_fit.h"

namespace sonar {

/// What a ping's echo tells of a school's body before beam and pulse are taken out.
struct BodyEcho {
  bool known = false;         ///< false = no echo above the background: nothing else means anything
  Covariance3 total{};        ///< of the echo round its centre, sonar frame, m^2
  Covariance3 blur{};         ///< what pulse and beam add to it, if it sends as narrowly as it receives, m^2
  Covariance3 upright{};      ///< the part of it that is the beam's in elevation
  Covariance3 sideways{};     ///< and in azimuth
  double two_way_area = 1.0;  ///< MeasureInput's
  Point<Sonar> centre;        ///< m
  double mean_range2_m2 = 0;  ///< echo-weighted mean of range squared
  LevelMoments level;
  double looks = 0.0;  ///< independent ones: members, over the samples of a pulse
  /// [shape of the beam] as beam_shapes(params, two_way_area); empty ones = too few fans to tell
  std::vector<HeightLikelihood> heights;
};

/// Second moments of the echo in and round the mask, and how likely which height of the body is.
/// The mask ends where the echo falls below its threshold, and moments cut there would be too small; so the echo is
/// taken from a wider stretch of water, where it dies away by itself; not from where beams hear the seabed.
[[nodiscard]] BodyEcho body_echo(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params);

}  // namespace sonar
