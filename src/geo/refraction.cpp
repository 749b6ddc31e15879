// SPDX-License-Identifier: Apache-2.0
#include "geo/refraction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "base/check.h"

namespace sonar {
namespace {

constexpr std::size_t kElevations = 361;
constexpr std::size_t kRanges = 257;
/// Level rays part where steep ones do not: the table's elevations lie closer the nearer they are to the level.
constexpr double kLevel_rad = 4.0 * std::numbers::pi / 180.0;
const double kSteepest = std::asinh(std::numbers::pi / 2 / kLevel_rad);

double row_of(double elevation_rad) {
  return (std::asinh(elevation_rad / kLevel_rad) / kSteepest + 1.0) * (kElevations - 1) / 2.0;
}
double elevation_at(double row) { return kLevel_rad * std::sinh((2.0 * row / (kElevations - 1) - 1.0) * kSteepest); }
double elevation_of(std::size_t row) { return elevation_at(static_cast<double>(row)); }

/// Each round of straightening comes nearer by the share in which neighbouring rays part, mostly a few hundredths.
constexpr int kRounds = 12;
constexpr double kNear_m = 1e-3;

/// The last whole step from which an index is reached: beyond the table its last step goes on. An index that is no number is
/// none of the table either: the first.
std::size_t whole(double index, std::size_t nodes) {
  return index > 0.0 ? static_cast<std::size_t>(std::min(index, static_cast<double>(nodes - 2))) : 0;
}

}  // namespace

Refraction::Refraction(const SoundProfile& profile, double transducer_depth_m, double sound_speed_mps,
                       double farthest_m)
    : step_m_(farthest_m / (kRanges - 1)), offsets_(kElevations * kRanges) {
  SONAR_CHECK(farthest_m > 0.0 && sound_speed_mps > 0.0);
  for (std::size_t e = 0; e < kElevations; ++e) {
    const double elevation = elevation_of(e);
    const double level = std::cos(elevation);
    const double down = -std::sin(elevation);
    SoundRay ray(profile, transducer_depth_m, elevation);
    for (std::size_t r = 1; r < kRanges; ++r) {
      ray.advance(step_m_ / sound_speed_mps);
      const RayPlace at = ray.place();
      const double range_m = step_m_ * static_cast<double>(r);
      offsets_[e * kRanges + r] = {static_cast<float>(at.distance_m - range_m * level),
                                   static_cast<float>(at.depth_m - transducer_depth_m - range_m * down)};
    }
  }
}

Point<Sonar> Refraction::bent(const Point<Sonar>& straight) const {
  const double level_m = std::hypot(straight.x, straight.y);
  const double row = row_of(std::atan2(-straight.z, level_m));
  const double column = norm(straight) / step_m_;
  const std::size_t e = whole(row, kElevations);
  const std::size_t r = whole(column, kRanges);
  const double up = row - static_cast<double>(e);
  const double on = column - static_cast<double>(r);
  const Offset* low = &offsets_[e * kRanges + r];
  const Offset* high = low + kRanges;
  const auto between = [&](float Offset::*part) {
    return (1.0 - up) * ((1.0 - on) * static_cast<double>(low[0].*part) + on * static_cast<double>(low[1].*part)) +
           up * ((1.0 - on) * static_cast<double>(high[0].*part) + on * static_cast<double>(high[1].*part));
  };
  const double stretch = level_m > 0.0 ? std::max(1.0 + between(&Offset::distance_m) / level_m, 0.0) : 1.0;
  return {straight.x * stretch, straight.y * stretch, straight.z + between(&Offset::down_m)};
}

Point<Sonar> Refraction::straightened(const Point<Sonar>& bent) const {
  Point<Sonar> straight = bent;
  for (int i = 0; i < kRounds; ++i) {
    const Point<Sonar> off = bent - this->bent(straight);
    if (norm(off) < kNear_m) return straight + off;
    straight = straight + off;
  }
  return searched(bent);
}

Refraction::Miss Refraction::miss(std::size_t row, double level_m, double down_m) const {
  const double elevation = elevation_of(row);
  const double level = std::cos(elevation) * step_m_;
  const Offset* offsets = &offsets_[row * kRanges];
  const auto reached_m = [&](std::size_t column) {
    return level * static_cast<double>(column) + static_cast<double>(offsets[column].distance_m);
  };
  std::size_t low = 0;
  for (std::size_t high = kRanges - 1; low + 1 < high;) {
    const std::size_t middle = (low + high) / 2;
    (reached_m(middle) < level_m ? low : high) = middle;
  }
  const double ahead_m = reached_m(low + 1) - reached_m(low);
  const double on = ahead_m > 0.0 ? (level_m - reached_m(low)) / ahead_m : 0.0;
  const double column = static_cast<double>(low) + on;
  const double there_m = -std::sin(elevation) * step_m_ * column +
                         (1.0 - on) * static_cast<double>(offsets[low].down_m) +
                         on * static_cast<double>(offsets[low + 1].down_m);
  return {column * step_m_, there_m - down_m};
}

Point<Sonar> Refraction::searched(const Point<Sonar>& bent) const {
  const double level_m = std::hypot(bent.x, bent.y);
  const double straight_row = row_of(std::atan2(-bent.z, level_m));
  double best_row = straight_row;
  double best_range_m = norm(bent);
  double least_m = std::numeric_limits<double>::infinity();  // missed by, where no ray comes
  double nearest = std::numeric_limits<double>::infinity();  // rows from the straight path, of rays that come there
  Miss above = miss(0, level_m, bent.z);
  for (std::size_t row = 1; row < kElevations; ++row) {
    const Miss below = std::exchange(above, miss(row, level_m, bent.z));
    const bool comes = (below.down_m > 0.0) != (above.down_m > 0.0);
    const double share = comes ? below.down_m / (below.down_m - above.down_m) : 0.0;
    const double at = static_cast<double>(row - 1) + share;
    const double off_m = comes ? 0.0 : std::abs(below.down_m);
    const double away = comes ? std::abs(at - straight_row) : nearest;
    if (off_m > least_m || (off_m == least_m && away >= nearest)) continue;
    least_m = off_m;
    nearest = away;
    best_row = at;
    best_range_m = below.range_m + share * (above.range_m - below.range_m);
  }
  const double elevation = elevation_at(best_row);
  const double stretch = level_m > 0.0 ? best_range_m * std::cos(elevation) / level_m : 1.0;
  return {bent.x * stretch, bent.y * stretch, -best_range_m * std::sin(elevation)};
}

}  // namespace sonar
