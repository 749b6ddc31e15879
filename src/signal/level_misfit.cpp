// SPDX-License-Identifier: Apache-2.0
#include "signal/level_misfit.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace sonar {
namespace {

constexpr double kEdge_db = kHalfBothWays_db;

double square(double x) { return x * x; }

}  // namespace

double form_se_db(double under_top_db) { return 0.05 + 0.02 * std::abs(under_top_db); }

Misfit misfit(const HeardLevel& heard, const FittedBeam& beam, const FittedBeam& stated, const PatternShape& shape,
              const FaceDirection& from, double refused_from) {
  const auto& k = shape.k;
  const double da = from.across - beam.centre.across;
  const double du = from.up - beam.centre.up;
  const double x = square(2.0 * da / beam.width_across);
  const double y = square(2.0 * du / beam.width_up);
  Misfit m;
  m.under_top_db = shape.db(x, y);
  m.residual_db = heard.level_db - beam.level_db - m.under_top_db;
  m.share = std::clamp((m.under_top_db - kFormEnds_db) / (kFormHolds_db - kFormEnds_db), 0.0, 1.0);
  if (m.share <= 0.0) return m;
  // Noise against what should have been heard: a level that noise has lifted looks better than it is.
  constexpr double kMostLifted_db = 12.0;
  const double lifted_db = std::clamp(m.residual_db, -kMostLifted_db, kMostLifted_db);
  const double variance = square(heard.se_db) * linear_from_db(lifted_db) + square(form_se_db(m.under_top_db));
  m.excess = std::abs(m.residual_db) / std::sqrt(variance);
  m.weight = m.share / variance;
  if (refused_from > 0.0) {
    const double far = m.excess / refused_from;
    m.weight *= far < 1.0 ? square(1.0 - far * far) : 0.0;
  }
  const double by_x = -kEdge_db - k[0] * (2.0 * x - 1.0) - k[2] * y;
  const double by_y = -kEdge_db - k[1] * (2.0 * y - 1.0) - k[2] * x;
  const double by_across = by_x * 8.0 * da / square(beam.width_across);
  const double by_up = by_y * 8.0 * du / square(beam.width_up);
  m.by_beam = {1.0, -2.0 * x * by_x, -2.0 * y * by_y, -by_across * stated.width_across, -by_up * stated.width_up};
  m.by_direction = {by_across, by_up};
  m.by_shape = {x - x * x, y - y * y, -x * y};
  return m;
}

std::vector<double> leverage(const std::vector<HeardLevel>& heard, const std::vector<Misfit>& misfits,
                             const std::vector<std::vector<std::size_t>>& of_ping, const std::vector<bool>& used) {
  std::vector<double> of_beam;
  for (std::size_t i = 0; i < heard.size(); ++i) {
    const auto beam = static_cast<std::size_t>(heard[i].beam);
    if (beam >= of_beam.size()) of_beam.resize(beam + 1);
    of_beam[beam] += misfits[i].weight;
  }
  std::vector<double> all(heard.size());
  for (std::size_t p = 0; p < of_ping.size(); ++p) {
    if (!used[p]) continue;
    DirectionEquations d;
    for (const std::size_t i : of_ping[p]) d.add(misfits[i]);
    for (const std::size_t i : of_ping[p]) {
      const Misfit& m = misfits[i];
      const auto by = d.solve(m.by_direction[0], m.by_direction[1]);
      const double of_direction = m.weight * (by[0] * m.by_direction[0] + by[1] * m.by_direction[1]);
      const double of_figures = m.weight > 0.0 ? static_cast<double>(BeamErrors::kFigures) * m.weight /
                                                     of_beam[static_cast<std::size_t>(heard[i].beam)]
                                               : 0.0;
      all[i] = std::min(1.0, of_direction + of_figures);
    }
  }
  return all;
}

}  // namespace sonar
