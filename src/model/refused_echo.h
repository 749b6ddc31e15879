// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/school.h"

namespace sonar {

/// An echo that lay clearly above the background in one ping and was judged no school: a row of /rejected. NaN = unknown.
struct RefusedEcho {
  std::int64_t ping_index = 0;
  std::int64_t echo_id = 0;  ///< 1..; the same in all pings in which it was followed
  std::int64_t channel = 0;  ///< 0-based, with `sample` a voxel where it is loudest: a click there selects it
  std::int64_t sample = 0;
  double latitude = kUnknown;
  double longitude = kUnknown;
  double depth_m = kUnknown;
  double range_m = kUnknown;
  std::int64_t n_beams = 0;       ///< of its box
  std::int64_t n_fans = 0;        ///< of its box
  double range_extent_m = 0.0;    ///< of its box
  double volume_m3 = kUnknown;    ///< sum of its cells
  double level_db = kUnknown;     ///< a school's reference level, dB re 1 m^-1
  double above_water = kUnknown;  ///< evidence, standard deviations of the water
  std::string judge;
  double figure = kUnknown;
  double limit = kUnknown;
  std::string limit_unit;  ///< of figure and limit
};

template <class Visitor>
void columns(Visitor& v, RefusedEcho& r) {
  v("ping_index", "1", r.ping_index);
  v("echo_id", "1", r.echo_id);
  v("channel", "1", r.channel);
  v("sample", "1", r.sample);
  v("latitude", "degrees_north", DegreesColumn{r.latitude});
  v("longitude", "degrees_east", DegreesColumn{r.longitude});
  v("depth_m", "m", r.depth_m);
  v("range_m", "m", r.range_m);
  v("n_beams", "1", r.n_beams);
  v("n_fans", "1", r.n_fans);
  v("range_extent_m", "m", r.range_extent_m);
  v("volume_m3", "m3", r.volume_m3);
  v("level_db", "dB re 1 m-1", r.level_db);
  v("above_water", "1", r.above_water);
  v("judge", "", r.judge);
  v("figure", "", r.figure);
  v("limit", "", r.limit);
  v("limit_unit", "", r.limit_unit);
}

/// Why it is no school, for people: "no school: 3.8 m along range, 5 at least (judge size)".
[[nodiscard]] std::string why_no_school(const RefusedEcho& echo);

/// An echo as a whole: where it was loudest, and how long it was followed.
struct RefusedSightings {
  const RefusedEcho* loudest = nullptr;
  std::int64_t first_ping = 0;
  std::int64_t last_ping = 0;
  std::int64_t pings = 0;
};
/// Rows of one observation, echo by echo, by rising number; they outlive what comes back.
[[nodiscard]] std::vector<RefusedSightings> refused_sightings(std::span<const RefusedEcho> rows);

}  // namespace sonar
