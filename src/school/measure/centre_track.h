// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "geo/frames.h"
#include "model/school.h"
#include "school/measure/line_fit.h"

namespace sonar {

/// Where a school's centre was in the pings that see it uncut along the ship and along range.
struct CentreTrack {
  Geographic origin;              ///< of the plane
  TimeNs start = 0;               ///< of `places.t`, which is in seconds
  TimedPlaces places;             ///< metres east and north
  std::vector<double> depth_m;    ///< [n]
  std::vector<std::size_t> rows;  ///< [n] of the rows that it was made from

  [[nodiscard]] std::size_t size() const { return rows.size(); }
  [[nodiscard]] double span_s() const { return rows.empty() ? 0.0 : places.t.back() - places.t.front(); }
  /// Whether it is long enough for a speed.
  [[nodiscard]] bool tells_speed(int min_pings, double min_span_s) const;
  /// Whether places [first, last) are three or more, not all at one time: then there is a line through them, and its error.
  [[nodiscard]] bool tells_line(std::size_t first, std::size_t last) const;
  /// Places [first, last).
  [[nodiscard]] TimedPlaces part(std::size_t first, std::size_t last) const;
};

/// rows  of one school, rising time
[[nodiscard]] CentreTrack uncut_track(std::span<const SchoolPingRow> rows);

/// Stretches of equal duration, as many whole windows as the track is long, at least one: [first, last) of its places.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> stretches(const CentreTrack& track, double window_s);

/// What a line's slope tells of a speed, and with what standard errors.
struct Speed {
  double speed_mps = kUnknown;
  double speed_se_mps = kUnknown;
  double course_deg = kUnknown;  ///< unknown where the speed is less than two standard errors
  double course_se_deg = kUnknown;
};

/// Speed and its standard error out of the slopes' noise. The length of a noisy vector is longer than the vector: by half
/// the variance across it over the length, so that the square less that variance is free of it but where the speed is lost
/// in its error. There the length is 0.
/// source  Wardle & Kronberg 1974, ApJ 194, 249, for the length of a polarisation vector
[[nodiscard]] Speed speed_of(const LineFit& line);

}  // namespace sonar
