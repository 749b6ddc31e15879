// SPDX-License-Identifier: Apache-2.0
#include "school/measure/water_current.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/check.h"
#include "geo/geodesic.h"
#include "model/school.h"

namespace sonar {
namespace {

double seconds(TimeNs time) { return static_cast<double>(time) / static_cast<double>(kSecondNs); }

/// One that tells of the time, the place and the depth.
struct Told {
  std::size_t profile = 0;
  CurrentAt value;
};

std::optional<Told> told_by(const CurrentProfiles& profiles, std::size_t i, const Geographic& place, double depth_m,
                            const CurrentParams& params) {
  const CurrentProfile& one = profiles[i];
  const bool placed = std::isfinite(one.place.latitude_deg) && std::isfinite(one.place.longitude_deg);
  if (placed && geodesic(one.place, place).distance_m > params.max_distance_m) return std::nullopt;
  const auto value = current_in(one, depth_m, params.max_depth_gap_m);
  return value ? std::optional(Told{i, *value}) : std::nullopt;
}

}  // namespace

std::optional<CurrentHere> current_at(const CurrentProfiles& profiles, TimeNs time, const Geographic& place,
                                      double depth_m, const CurrentParams& params) {
  const auto next = std::lower_bound(profiles.begin(), profiles.end(), time,
                                     [](const CurrentProfile& one, TimeNs wanted) { return one.time < wanted; });
  const auto at = static_cast<std::size_t>(next - profiles.begin());
  std::optional<Told> before;
  std::optional<Told> after;
  for (std::size_t i = at; i-- > 0 && !before && seconds(time - profiles[i].time) <= params.max_gap_s;) {
    before = told_by(profiles, i, place, depth_m, params);
  }
  for (std::size_t i = at; i < profiles.size() && !after && seconds(profiles[i].time - time) <= params.max_gap_s; ++i) {
    after = told_by(profiles, i, place, depth_m, params);
  }
  if (!before && !after) return std::nullopt;
  if (!before) before = after;
  if (!after) after = before;
  CurrentHere out{0.0, 0.0, before->profile, after->profile, 0.0};
  if (after->profile != before->profile) {
    const TimeNs from = profiles[before->profile].time;
    out.share_of_after = seconds(time - from) / seconds(profiles[after->profile].time - from);
  }
  out.east_mps = before->value.east_mps + out.share_of_after * (after->value.east_mps - before->value.east_mps);
  out.north_mps = before->value.north_mps + out.share_of_after * (after->value.north_mps - before->value.north_mps);
  return out;
}

double current_noise_mps(const CurrentProfiles& profiles, const CurrentParams& params) {
  double sum = 0.0;
  double count = 0.0;
  constexpr double kSameBin_m = 0.5;  // bins heave with the ship
  for (std::size_t i = 1; i + 1 < profiles.size(); ++i) {
    const CurrentProfile& before = profiles[i - 1];
    const CurrentProfile& after = profiles[i + 1];
    const double apart_s = seconds(after.time - before.time);
    if (!(apart_s > 0.0) || apart_s > 2.0 * params.max_gap_s) continue;
    const double w = seconds(profiles[i].time - before.time) / apart_s;
    const double variances = 1.0 + w * w + (1.0 - w) * (1.0 - w);
    for (const CurrentAt& bin : profiles[i].bins) {
      const auto a = current_in(before, bin.depth_m, kSameBin_m);
      const auto b = current_in(after, bin.depth_m, kSameBin_m);
      if (!a || !b) continue;
      const double east = bin.east_mps - (1.0 - w) * a->east_mps - w * b->east_mps;
      const double north = bin.north_mps - (1.0 - w) * a->north_mps - w * b->north_mps;
      sum += (east * east + north * north) / (2.0 * variances);
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(sum / count) : kUnknown;
}

DriftedWater::DriftedWater(std::vector<double> t, std::vector<CurrentHere> here, double noise_mps)
    : t_(std::move(t)), here_(std::move(here)), noise_mps_(noise_mps) {
  SONAR_CHECK(t_.size() == here_.size());
  for (std::size_t i = 0; i < t_.size(); ++i) {
    const CurrentHere& now = here_[i];
    const CurrentHere& then = here_[i == 0 ? 0 : i - 1];
    const double half_s = i == 0 ? 0.0 : (t_[i] - t_[i - 1]) / 2.0;
    east_m_.push_back((i == 0 ? 0.0 : east_m_.back()) + half_s * (now.east_mps + then.east_mps));
    north_m_.push_back((i == 0 ? 0.0 : north_m_.back()) + half_s * (now.north_mps + then.north_mps));
  }
}

CurrentAlong DriftedWater::along(std::size_t first, std::size_t last) const {
  SONAR_CHECK(first + 2 <= last && last <= t_.size());
  TimedPlaces drifted;
  CurrentAlong out;
  const double n = static_cast<double>(last - first);
  std::map<std::size_t, double> shares;  // of profiles in the mean
  for (std::size_t i = first; i < last; ++i) {
    drifted.t.push_back(t_[i]);
    drifted.x.push_back(east_m_[i]);
    drifted.y.push_back(north_m_[i]);
    out.east_mps += here_[i].east_mps / n;
    out.north_mps += here_[i].north_mps / n;
    shares[here_[i].before] += (1.0 - here_[i].share_of_after) / n;
    shares[here_[i].after] += here_[i].share_of_after / n;
  }
  out.drift = fit_line(drifted, Scatter{});
  double squares = 0.0;
  for (const auto& [profile, share] : shares) squares += share * share;
  out.error_mps = noise_mps_ * std::sqrt(squares);
  const double variance = std::isfinite(noise_mps_) ? out.error_mps * out.error_mps : 0.0;
  out.drift.variance_xx = out.drift.variance_yy = variance;
  return out;
}

std::optional<DriftedWater> drifted_water(const CentreTrack& track, std::span<const SchoolPingRow> rows,
                                          const WaterCurrents& water) {
  std::vector<CurrentHere> here;
  for (const std::size_t i : track.rows) {
    const SchoolPingRow& row = rows[i];
    const auto one =
        current_at(*water.profiles, row.time_utc, {row.latitude, row.longitude}, row.depth_m, water.params);
    if (!one) return std::nullopt;
    here.push_back(*one);
  }
  return DriftedWater(track.places.t, std::move(here), water.noise_mps);
}

LineFit through_water(const LineFit& over_ground, const LineFit& drift) {
  return {over_ground.slope_x - drift.slope_x, over_ground.slope_y - drift.slope_y,
          over_ground.variance_xx + drift.variance_xx, over_ground.variance_xy + drift.variance_xy,
          over_ground.variance_yy + drift.variance_yy};
}

Speed speed_through_water(const LineFit& over_ground, const CurrentAlong& current) {
  Speed out = speed_of(through_water(over_ground, current.drift));
  // Nobody knows how far the current is off: neither its error nor whether there is a course.
  if (!std::isfinite(current.error_mps)) return {.speed_mps = out.speed_mps};
  return out;
}

}  // namespace sonar
