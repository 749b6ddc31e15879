// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "signal/pattern_form.h"

namespace sonar {

/// One beam's level of a sphere in one ping.
struct HeardLevel {
  int ping = 0;
  int beam = 0;
  double level_db = 0.0;  ///< its echo over its target strength, spreading and absorption undone
  double se_db = 0.0;     ///< by the noise
};

/// Of a beam's five figures in the order of their names below. What the form does not describe is in it as an error that no
/// number of pings averages out.
struct BeamErrors {
  static constexpr std::size_t kFigures = 5;
  enum Figure { level_db, log_width_across, log_width_up, centre_across, centre_up };  // centres in widths
  std::array<std::array<double, kFigures>, kFigures> covariance{};
};

struct PatternFit {
  std::vector<FittedBeam> beams;          ///< [beam]; those that were not heard as they were stated
  std::vector<BeamErrors> errors;         ///< [beam]
  std::vector<int> hits;                  ///< [beam], levels inside the -6 dB contour that count
  std::vector<bool> crossed;              ///< [beam], hits lie on all sides of the centre
  std::vector<FaceDirection> directions;  ///< [ping]
  std::vector<bool> used;                 ///< [ping]
  PatternShape shape;
  std::vector<double> residual_db;  ///< [heard]; NaN = not used
  double residual_rms_db = 0.0;     ///< of those used, weighted
  double form_se_db = 0.0;          ///< inside the -6 dB contour: what the noise does not explain
  int iterations = 0;
};

/// Finds beams and the sphere's direction in each ping together, by robust weighted least squares. The directions are in no
/// record: they follow from the levels of neighbouring beams, against each other and against the sphere's known strength.
/// The stated steering is taken as true on the average: each centre is held to it by a fiftieth of a width. The same elements
/// make all beams: widths against those stated are alike within 5 % (1 sigma), whatever they all are.
/// stated  figures to begin with
/// heard   any order; pings with levels of fewer than four beams take no part
/// source  the two-way pattern within -6 dB: Simrad ER60 manual; elimination of the directions: any text on bundle
///         adjustment (Schur's complement)
/// cost    seconds for 500 beams and some thousand pings
[[nodiscard]] PatternFit fit_patterns(const std::vector<FittedBeam>& stated, const std::vector<HeardLevel>& heard,
                                      int pings);

}  // namespace sonar
