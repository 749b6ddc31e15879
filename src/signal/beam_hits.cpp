// SPDX-License-Identifier: Apache-2.0
#include "signal/beam_hits.h"

#include <algorithm>
#include <cstddef>

namespace sonar {
namespace {

/// A beam was crossed where so many levels lie on all sides of its centre, by so much of a width.
constexpr int kLeastHits = 8;
constexpr double kAside = 0.25;

/// The outermost places on each side of a beam's centre, widths.
struct Sides {
  double least_across = 0.0, most_across = 0.0, least_up = 0.0, most_up = 0.0;
};

}  // namespace

BeamHits hits_of(std::span<const FittedBeam> beams, std::span<const HeardLevel> heard, std::span<const Misfit> misfits,
                 std::span<const FaceDirection> directions) {
  BeamHits hits{std::vector<int>(beams.size()), std::vector<bool>(beams.size())};
  std::vector<Sides> sides(beams.size());
  for (std::size_t i = 0; i < heard.size(); ++i) {
    if (misfits[i].weight <= 0.0 || misfits[i].under_top_db < -kHalfBothWays_db) continue;
    const auto b = static_cast<std::size_t>(heard[i].beam);
    ++hits.count[b];
    const FittedBeam& of = beams[b];
    const FaceDirection& from = directions[static_cast<std::size_t>(heard[i].ping)];
    const double across = (from.across - of.centre.across) / of.width_across;
    const double up = (from.up - of.centre.up) / of.width_up;
    Sides& s = sides[b];
    s = {std::min(s.least_across, across), std::max(s.most_across, across), std::min(s.least_up, up),
         std::max(s.most_up, up)};
  }
  for (std::size_t b = 0; b < beams.size(); ++b) {
    const Sides& s = sides[b];
    hits.crossed[b] = hits.count[b] >= kLeastHits && s.least_across < -kAside && s.most_across > kAside &&
                      s.least_up < -kAside && s.most_up > kAside;
  }
  return hits;
}

}  // namespace sonar
