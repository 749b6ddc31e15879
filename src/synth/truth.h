// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/array.h"
#include "base/time.h"
#include "geo/sector.h"
#include "model/beam_grid.h"
#include "model/mask.h"
#include "model/navigation.h"
#include "model/product.h"
#include "model/school.h"

namespace sonar::synth {

/// A body itself in one ping, free of beam effects: a row of bodies.csv.
struct BodyTruth {
  std::string observation;
  std::int64_t school_id = 0;
  std::int64_t ping_index = 0;
  TimeNs time_utc = 0;
  double latitude = kUnknown;
  double longitude = kUnknown;
  double depth_m = kUnknown;
  double length_m = kUnknown;
  double width_m = kUnknown;
  double height_m = kUnknown;
  double volume_m3 = kUnknown;
  double sv_mean_db = kUnknown;
  double backscatter_m2 = kUnknown;
  double east_mps = kUnknown;
  double north_mps = kUnknown;
  double down_mps = kUnknown;
  double speed_mps = kUnknown;
  double course_deg = kUnknown;
  double range_m = kUnknown;
  double fraction_inside = 0.0;  ///< share of its backscatter inside the sector
};

template <class Visitor>
void columns(Visitor& v, BodyTruth& r) {
  v("observation", "", r.observation);
  v("school_id", "", r.school_id);
  v("ping_index", "", r.ping_index);
  v("time_utc", "", TimeColumn{r.time_utc});
  v("latitude", "degrees_north", DegreesColumn{r.latitude});
  v("longitude", "degrees_east", DegreesColumn{r.longitude});
  v("depth_m", "m", r.depth_m);
  v("length_m", "m", r.length_m);
  v("width_m", "m", r.width_m);
  v("height_m", "m", r.height_m);
  v("volume_m3", "m3", r.volume_m3);
  v("sv_mean_db", "dB re 1 m-1", r.sv_mean_db);
  v("backscatter_m2", "m2", r.backscatter_m2);
  v("east_mps", "m s-1", r.east_mps);
  v("north_mps", "m s-1", r.north_mps);
  v("down_mps", "m s-1", r.down_mps);
  v("speed_mps", "m s-1", r.speed_mps);
  v("course_deg", "degrees", r.course_deg);
  v("range_m", "m", r.range_m);
  v("fraction_inside", "1", r.fraction_inside);
}

/// A school in one ping as a perfect observer of this sonar would mark it.
struct SchoolTruth {
  PingMask mask;  ///< confidence 255 everywhere
  SchoolPingRow row;
};

/// Expected sv of one school on a part of the grid.
struct SchoolField {
  int school_id = 0;
  int first_fan = 0;
  int first_beam = 0;
  int first_sample = 0;
  Array3<float> sv;  ///< linear, m^-1
};

/// Where in a row voxels cannot be members: samples below near_end, from surface_begin, from seabed_begin, from count.
struct RowLimits {
  int near_end = 0;
  int surface_begin = 0;
  int seabed_begin = 0;
  int count = 0;
  [[nodiscard]] bool member(int sample) const {
    return sample >= near_end && sample < surface_begin && sample < seabed_begin && sample < count;
  }
};

/// What the truth of one ping is told from.
struct TruthInput {
  const BeamGrid& grid;
  const Sector& sector;
  const PingNavigation& navigation;
  const std::vector<RowLimits>& limits;                      ///< [row]
  std::function<double(int row, int sample)> background_sv;  ///< expected, linear
  std::int64_t ping_index = 0;
};

/// How near, surface and seabed are cut away in the truth: the defaults of the recipe, worked out separately here.
inline constexpr double kTruthNear_m = 15.0;
inline constexpr double kTruthSurfaceMargin_m = 2.0;

/// Masks and rows of all schools of a ping. A voxel is a school's where that school's expected sv is within 10 dB of
/// its strongest in this ping, above the background, not outside, and no other school is stronger there.
/// Brute force, and nothing of the code that it judges.
[[nodiscard]] std::vector<SchoolTruth> school_truth(const TruthInput& in, const std::vector<SchoolField>& fields);

/// One row for each school from its rows in single pings and its bodies.
[[nodiscard]] std::vector<SchoolRow> school_rows(const std::vector<SchoolPingRow>& rows,
                                                 const std::vector<BodyTruth>& bodies);

}  // namespace sonar::synth
