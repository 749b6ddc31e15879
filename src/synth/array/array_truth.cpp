// SPDX-License-Identifier: Apache-2.0
#include "synth/array/array_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/units.h"
#include "geo/geodesic.h"

namespace sonar::synth::array {
namespace {

struct Extent {
  double least = std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::lowest();
  void add(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
  [[nodiscard]] double size() const { return most - least; }
};

/// Visits the numbers of a parameter group.
class NumberRows {
 public:
  NumberRows(std::string observation, std::vector<WaterTruth>& rows)
      : observation_(std::move(observation)), rows_(rows) {}
  void field(std::string_view name, double& value, const FieldInfo&) {
    rows_.push_back({observation_, std::string(name), value});
  }

 private:
  std::string observation_;
  std::vector<WaterTruth>& rows_;
};

}  // namespace

std::vector<WaterTruth> water_rows(const std::string& observation, const Sea& sea) {
  std::vector<WaterTruth> rows;
  NumberRows visitor(observation, rows);
  Company company = sea.company;
  describe(visitor, company);
  rows.push_back({observation, "gradient_per_s", sea.gradient_per_s});
  rows.push_back({observation, "wind_deg", deg_from_rad(sea.wind_rad)});
  rows.push_back({observation, "hull_clouds", static_cast<double>(sea.hull.size())});
  rows.push_back({observation, "layer_count", static_cast<double>(sea.layers.size())});
  return rows;
}

BodyTruth body_row(const School& school, const View& view, const Sector& sector, const std::vector<PlacedEcho>& echoes,
                   int ping) {
  BodyTruth row;
  row.school_id = school.id;
  row.ping_index = ping;
  row.time_utc = view.navigation.time;
  const AngleBounds bottom = sector.elevation_bounds(0);
  const AngleBounds top = sector.elevation_bounds(sector.fans() - 1);
  const AngleBounds aft = sector.azimuth_bounds(0);
  const AngleBounds fore = sector.azimuth_bounds(sector.beams() - 1);
  const double turn = 2.0 * std::numbers::pi;
  double sum = 0.0;
  double inside = 0.0;
  Point<Enu> centre;
  Extent along;
  Extent across;
  Extent up;
  for (const PlacedEcho& e : echoes) {
    sum += e.expected_m2;
    centre = centre + e.at * e.expected_m2;
    along.add(e.at.x * std::sin(school.axis_rad) + e.at.y * std::cos(school.axis_rad));
    across.add(e.at.x * std::cos(school.axis_rad) - e.at.y * std::sin(school.axis_rad));
    up.add(e.at.z);
    const Point<Vessel> v = view.along_ship(e.at);
    const double r = norm(e.at);
    const double elevation = std::asin(std::clamp(-v.z / std::max(1.0, r), -1.0, 1.0));
    double azimuth = std::atan2(v.y, v.x);
    while (azimuth < aft.lower) azimuth += turn;
    while (azimuth >= aft.lower + turn) azimuth -= turn;
    const bool in = elevation >= bottom.lower && elevation < top.upper && azimuth < fore.upper &&
                    r <= sector.range().range_m(sector.range().count - 1);
    if (in) inside += e.expected_m2;
  }
  centre = centre * (1.0 / sum);
  const Geographic place = to_geographic(centre, view.navigation.transducer);
  row.latitude = place.latitude_deg;
  row.longitude = place.longitude_deg;
  row.depth_m = view.navigation.transducer_depth_m - centre.z;
  row.range_m = norm(centre);
  row.length_m = std::max(along.size(), across.size());
  row.width_m = std::min(along.size(), across.size());
  row.height_m = up.size();
  row.volume_m3 = school.volume_m3 * school.form.swelling(view.seconds);
  row.backscatter_m2 = sum;
  row.sv_mean_db = db_from_linear(sum / row.volume_m3);
  row.east_mps = school.velocity_mps.x;
  row.north_mps = school.velocity_mps.y;
  row.down_mps = -school.velocity_mps.z;
  row.speed_mps = std::hypot(row.east_mps, row.north_mps);
  row.course_deg = wrap_360(deg_from_rad(std::atan2(row.east_mps, row.north_mps)));
  row.fraction_inside = inside / sum;
  return row;
}

FishTruth fish_row(const School& school, const BodyTruth& body) {
  FishTruth row;
  row.school_id = body.school_id;
  row.ping_index = body.ping_index;
  row.form = kFormNames[static_cast<std::size_t>(school.form.kind())];
  row.fish = static_cast<std::int64_t>(school.fish());
  row.fish_length_cm = school.fish_length_cm;
  row.sigma_bs_m2 = body.backscatter_m2;
  row.ts_mean_db = db_from_linear(body.backscatter_m2 / school.fish());
  row.per_m3 = school.fish() / body.volume_m3;
  row.length_m = body.length_m;
  row.width_m = body.width_m;
  row.height_m = body.height_m;
  row.axis_deg = wrap_360(deg_from_rad(school.axis_rad));
  return row;
}

}  // namespace sonar::synth::array
