// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "signal/beam_pattern_fit.h"

namespace sonar {

inline constexpr std::size_t kShapes = 3;  ///< of PatternShape

/// Levels count down to kFormHolds_db under the top, and ever less to kFormEnds_db: farther out the beam has no form of its own.
inline constexpr double kFormHolds_db = -11.0;
inline constexpr double kFormEnds_db = -15.0;
/// How well the form holds: near the top better than at the flanks. Only ratios count, the rest is scaled.
[[nodiscard]] double form_se_db(double under_top_db);

/// A level against what it should be, and how that changes.
struct Misfit {
  double residual_db = 0.0;
  double weight = 0.0;  ///< 0 = takes no part
  double under_top_db = 0.0;
  double share = 0.0;   ///< 1 near the top, 0 where no form is known
  double excess = 0.0;  ///< residual over its standard error
  std::array<double, BeamErrors::kFigures> by_beam{};
  std::array<double, 2> by_direction{};
  std::array<double, kShapes> by_shape{};
};

/// Two equations of one ping's direction.
struct DirectionEquations {
  double aa = 0.0, au = 0.0, uu = 0.0;  ///< normal matrix
  double ga = 0.0, gu = 0.0;
  void add(const Misfit& m) {
    aa += m.weight * m.by_direction[0] * m.by_direction[0];
    au += m.weight * m.by_direction[0] * m.by_direction[1];
    uu += m.weight * m.by_direction[1] * m.by_direction[1];
    ga += m.weight * m.by_direction[0] * m.residual_db;
    gu += m.weight * m.by_direction[1] * m.residual_db;
  }
  [[nodiscard]] bool sound() const {
    const double det = aa * uu - au * au;
    return aa > 0.0 && uu > 0.0 && det > 1e-6 * aa * uu;
  }
  [[nodiscard]] std::array<double, 2> solve(double a, double u) const {
    const double det = aa * uu - au * au;
    return {(uu * a - au * u) / det, (aa * u - au * a) / det};
  }
};

/// stated        whose widths the centres are counted in
/// refused_from  residual in standard errors from which on a level does not count (Tukey's biweight); 0 = all count
[[nodiscard]] Misfit misfit(const HeardLevel& heard, const FittedBeam& beam, const FittedBeam& stated,
                            const PatternShape& shape, const FaceDirection& from, double refused_from);

/// How much of each level's own error its residual lacks, 0 .. 1: what the ping's direction and the beam took of it.
/// misfits  [heard]
/// of_ping  [ping] indices of heard; those of pings that are not `used` stay 0
[[nodiscard]] std::vector<double> leverage(const std::vector<HeardLevel>& heard, const std::vector<Misfit>& misfits,
                                           const std::vector<std::vector<std::size_t>>& of_ping,
                                           const std::vector<bool>& used);

}  // namespace sonar
