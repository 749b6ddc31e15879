// SPDX-License-Identifier: Apache-2.0
#include "geo/refraction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

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
double elevation_of(std::size_t row) {
  return kLevel_rad * std::sinh((2.0 * static_cast<double>(row) / (kElevations - 1) - 1.0) * kSteepest);
}

/// Each round of straightening comes nearer by the share in which neighbouring rays part, a few hundredths.
constexpr int kRounds = 12;

/// The last whole step from which an index is reached: beyond the table its last step goes on.
std::size_t whole(double index, std::size_t nodes) {
  return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(nodes - 2)));
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
  for (int i = 0; i < kRounds; ++i) straight = straight + (bent - this->bent(straight));
  return straight;
}

}  // namespace sonar
