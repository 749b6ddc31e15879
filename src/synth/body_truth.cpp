// SPDX-License-Identifier: Apache-2.0
#include "synth/body_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar::synth {

void BodyMeasure::add(const Body& body, const Scatterers& scatterers, const Point<Enu>& centre_from_transducer,
                      double seconds) {
  parts_.push_back({&body, &scatterers, centre_from_transducer, body.velocity_at(seconds)});
}

void BodyMeasure::measure_extents(BodyTruth& row) const {
  const Part& first = parts_.front();
  if (parts_.size() == 1) {
    row.length_m = first.scatterers->length_m;
    row.width_m = first.scatterers->width_m;
    row.height_m = first.scatterers->height_m;
    return;
  }
  const double axis = rad_from_deg(first.body->shape.axis_deg);
  constexpr double kFar = std::numeric_limits<double>::max();
  Point<Enu> least{kFar, kFar, kFar};  // along, across, up
  Point<Enu> most{-kFar, -kFar, -kFar};
  for (const Part& part : parts_) {
    for (const Scatterer& s : part.scatterers->points) {
      const Point<Enu> p = part.centre + s.offset_m;
      const double along = p.x * std::sin(axis) + p.y * std::cos(axis);
      const double across = p.x * std::cos(axis) - p.y * std::sin(axis);
      least = {std::min(least.x, along), std::min(least.y, across), std::min(least.z, p.z)};
      most = {std::max(most.x, along), std::max(most.y, across), std::max(most.z, p.z)};
    }
  }
  row.length_m = std::max(most.x - least.x, most.y - least.y);
  row.width_m = std::min(most.x - least.x, most.y - least.y);
  row.height_m = most.z - least.z;
}

double BodyMeasure::inside_backscatter_m2(const std::vector<SeenScatterer>& seen) const {
  if (!layout_.grid) return 0.0;
  const Sector sector = layout_.grid->grid.sector(layout_.range);
  const AngleBounds bottom = sector.elevation_bounds(0);
  const AngleBounds top = sector.elevation_bounds(sector.fans() - 1);
  const AngleBounds aft = sector.azimuth_bounds(0);
  const AngleBounds fore = sector.azimuth_bounds(sector.beams() - 1);
  double inside = 0.0;
  for (const SeenScatterer& s : seen) {
    if (s.elevation_rad < bottom.lower || s.elevation_rad >= top.upper || s.azimuth_rad < aft.lower ||
        s.azimuth_rad >= fore.upper || s.sample < 0.0 || s.sample > layout_.range.count - 1) {
      continue;
    }
    const double r = layout_.range.range_m(s.sample);
    inside += s.weight * r * r * layout_.range.spacing_m;
  }
  return inside;
}

BodyTruth BodyMeasure::row(const std::vector<SeenScatterer>& seen, const PingNavigation& navigation, int school_id,
                           int ping) const {
  BodyTruth row;
  row.school_id = school_id;
  row.ping_index = ping;
  row.time_utc = navigation.time;
  row.volume_m3 = 0.0;
  row.backscatter_m2 = 0.0;
  Point<Enu> centre;
  Point<Enu> velocity;
  for (const Part& part : parts_) {
    Point<Enu> offset;
    for (const Scatterer& s : part.scatterers->points) offset = offset + s.offset_m * s.backscatter_m2;
    centre = centre + part.centre * part.scatterers->backscatter_m2 + offset;
    velocity = velocity + part.velocity * part.scatterers->backscatter_m2;
    row.volume_m3 += part.scatterers->volume_m3;
    row.backscatter_m2 += part.scatterers->backscatter_m2;
  }
  if (!(row.backscatter_m2 > 0.0)) return row;
  centre = centre * (1.0 / row.backscatter_m2);
  velocity = velocity * (1.0 / row.backscatter_m2);
  const Geographic place = to_geographic(centre, navigation.transducer);
  row.latitude = place.latitude_deg;
  row.longitude = place.longitude_deg;
  row.depth_m = navigation.transducer_depth_m - centre.z;
  row.range_m = norm(centre);
  row.sv_mean_db = db_from_linear(row.backscatter_m2 / row.volume_m3);
  row.east_mps = velocity.x;
  row.north_mps = velocity.y;
  row.down_mps = -velocity.z;
  row.speed_mps = std::hypot(velocity.x, velocity.y);
  row.course_deg = wrap_360(deg_from_rad(std::atan2(velocity.x, velocity.y)));
  measure_extents(row);
  constexpr double kRounding = 1e-9;
  const double inside = inside_backscatter_m2(seen) / row.backscatter_m2;
  row.fraction_inside = inside > 1.0 - kRounding ? 1.0 : inside;
  return row;
}

void complete_from_body(SchoolPingRow& row, const std::vector<BodyTruth>& bodies) {
  for (const BodyTruth& body : bodies) {
    if (body.school_id != row.school_id) continue;
    row.volume_corrected_m3 = body.volume_m3;
    row.length_corrected_m = body.length_m;
    row.width_corrected_m = body.width_m;
    row.height_corrected_m = body.height_m;
    row.sv_corrected_db = body.sv_mean_db;
  }
}

}  // namespace sonar::synth
