// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/seabed_stretch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/middle.h"
#include "school/seabed/seabed_echoes.h"
#include "school/seabed/seabed_plane.h"

namespace sonar {
namespace {

constexpr double kMost = 1.6;     ///< a beam whose range differs more is judged with the water, not the seabed
constexpr double kHills = 3.0;    ///< standard deviations of its depth above which few hills rise
constexpr double kNearest = 0.5;  ///< share of its depth that hills leave at least
/// A beam hears the seabed first by the foot of its main lobe; that meets it at angles at which a plane's slope, which is
/// never quite known, moves its range less than on the axes of beams that graze it.
constexpr double kBeamEdge_rad = 0.105;
constexpr double kBeyondRecord = 1.25;  ///< a seabed so far beyond the record is not heard

SeabedPlane plane_of(const Seabed& seabed) { return {seabed.offset_m, seabed.slope_x, seabed.slope_y}; }

/// One that may be trusted: files that were reduced tell their own.
bool has_seabed(const WaterPing& ping) {
  return ping.seabed != nullptr && ping.seabed->found && ping.seabed->offset_m > 0.0;
}

/// Range of a fan's beams to a level seabed at the window's depth; infinite where they meet none.
double usual_range_m(const Sector& sector, int fan, double depth_m) {
  const double down = -std::sin(sector.elevation_rad(fan) - kBeamEdge_rad);
  return down > 1e-6 ? depth_m / down : INFINITY;
}

std::vector<float> stretch_of(const Seabed& seabed, const Sector& sector, double depth_m) {
  std::vector<float> stretch(static_cast<std::size_t>(sector.fans() * sector.beams()), 1.0F);
  const double last_m = sector.range().range_m(sector.range().count);
  for (int fan = 0; fan < sector.fans(); ++fan) {
    const double usual_m = usual_range_m(sector, fan, depth_m);
    if (!(usual_m < kBeyondRecord * last_m)) continue;
    for (int beam = 0; beam < sector.beams(); ++beam) {
      const int row = fan * sector.beams() + beam;
      const double by = usual_m / plane_of(seabed).range(Sector::direction(sector.elevation_rad(fan) - kBeamEdge_rad,
                                                                           sector.azimuth_rad(beam)));
      stretch[static_cast<std::size_t>(row)] = static_cast<float>(std::clamp(by, 1.0 / kMost, kMost));
    }
  }
  return stretch;
}

}  // namespace

std::vector<std::vector<float>> seabed_stretch(std::span<const WaterPing> window, const Sector& sector) {
  std::vector<std::vector<float>> stretch(window.size());
  std::vector<double> depths_m;
  for (const WaterPing& ping : window) {
    if (has_seabed(ping)) depths_m.push_back(ping.seabed->offset_m);
  }
  if (depths_m.empty()) return stretch;
  const double depth_m = middle_of(std::move(depths_m));
  for (std::size_t p = 0; p < window.size(); ++p) {
    if (has_seabed(window[p])) stretch[p] = stretch_of(*window[p].seabed, sector, depth_m);
  }
  return stretch;
}

double seabed_nearer(std::span<const WaterPing> window) {
  std::vector<double> shares;
  for (const WaterPing& ping : window) {
    if (!has_seabed(ping)) continue;
    shares.push_back(std::max(1.0 - kHills * ping.seabed->roughness_m / ping.seabed->offset_m, kNearest));
  }
  return shares.empty() ? 1.0 : middle_of(std::move(shares));
}

}  // namespace sonar
