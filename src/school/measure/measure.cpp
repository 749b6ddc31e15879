// SPDX-License-Identifier: Apache-2.0
#include "school/measure/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>

#include "base/check.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "school/mask_shape.h"
#include "school/measure/body_echo.h"
#include "school/measure/describe_school.h"
#include "school/measure/echo_statistics.h"
#include "school/measure/edges.h"
#include "school/measure/total_echo.h"
#include "school/runs.h"

namespace sonar {
namespace {

/// How much deeper sound from there comes from than a straight path says.
double depth_error_m(const Point<Sonar>& centre, Placement placement, const std::shared_ptr<const Refraction>& rays) {
  placement.rays = nullptr;
  const double straight_m = levelled(centre, placement).z;
  placement.rays = rays;
  return levelled(centre, placement).z - straight_m;
}

void measure_place(const MeasureInput& ping, const MaskShape& shape, SchoolPingRow& row) {
  const Point<Sonar> centre = levelled(shape.centre, ping.placement);
  const Point<Enu> place = to_enu(centre, ping.placement.heading_rad);
  const Geographic where = to_geographic(place, ping.placement.transducer);
  row.latitude = where.latitude_deg;
  row.longitude = where.longitude_deg;
  row.depth_m = ping.placement.transducer_depth_m + centre.z;
  if (ping.rays) row.depth_error_m = depth_error_m(shape.centre, ping.placement, ping.rays);
  row.range_m = norm(shape.centre);
  row.bearing_deg = wrap_360(deg_from_rad(std::atan2(place.x, place.y)));
}

void measure_extents(const MeasureInput& ping, const PingMask& mask, const MaskShape& shape, SchoolPingRow& row) {
  const MaskExtents extents = mask_extents(mask, shape.covariance, *ping.sector, ping.placement);
  row.length_m = extents.length_m;
  row.width_m = extents.width_m;
  row.axis_deg = extents.axis_deg;
  row.depth_min_m = extents.depth_min_m;
  row.depth_max_m = extents.depth_max_m;
  row.height_m = extents.depth_max_m - extents.depth_min_m;
}

void count_voxels(const PingMask& mask, int beams, SchoolPingRow& row) {
  const IndexBox box = box_of(mask, beams);
  std::vector<bool> beam_seen(static_cast<std::size_t>(box.beams()), false);
  std::vector<bool> fan_seen(static_cast<std::size_t>(box.fans()), false);
  for (const Run& run : mask.runs) {
    beam_seen[static_cast<std::size_t>(run.row % beams - box.first_beam)] = true;
    fan_seen[static_cast<std::size_t>(run.row / beams - box.first_fan)] = true;
  }
  row.n_voxels = static_cast<std::int64_t>(mask.voxels());
  row.n_beams = std::count(beam_seen.begin(), beam_seen.end(), true);
  row.n_fans = std::count(fan_seen.begin(), fan_seen.end(), true);
}

/// Sums of the echo of valid members: as it is, under another beam angle, and times its standard error.
class CalibrationDoubt {
 public:
  explicit CalibrationDoubt(const MeasureInput& ping) : ping_(ping) {}

  /// echo_m2  of the valid members of a run
  void add(int row, double echo_m2) {
    whole_ += echo_m2;
    other_ += echo_m2 * linear_from_db(-at(ping_.psi_error_db, row));
    error_ += echo_m2 * at(ping_.calibration_se_db, row);
  }
  void tell(SchoolPingRow& row) const {
    if (!(whole_ > 0.0)) return;
    if (other_ > 0.0) row.backscatter_psi_error_db = db_from_linear(whole_ / other_);
    if (error_ >= 0.0) row.backscatter_calibration_se_db = error_ / whole_;
  }

 private:
  static double at(std::span<const double> values, int row) {
    const auto i = static_cast<std::size_t>(row);
    return i < values.size() ? values[i] : kUnknown;
  }
  const MeasureInput& ping_;
  double whole_ = 0.0;
  double other_ = 0.0;
  double error_ = 0.0;
};

void measure_echo(const MeasureInput& ping, const PingMask& mask, SchoolPingRow& row) {
  CalibrationDoubt doubt(ping);
  const EchoStatistics echo =
      echo_statistics(ping, mask, [&](int of_row, double echo_m2) { doubt.add(of_row, echo_m2); });
  row.valid_fraction = echo.volume_m3 > 0.0 ? echo.heard_m3 / echo.volume_m3 : kUnknown;
  if (std::isnan(echo.mean_sv_per_m)) return;
  row.sv_mean_db = echo.sv_mean_db;
  row.backscatter_m2 = echo.mean_sv_per_m * row.volume_m3;
  doubt.tell(row);
  row.snr_db = echo.snr_db;
  row.sv_p5_db = echo.sv_p5_db;
  row.sv_p50_db = echo.sv_p50_db;
  row.sv_p95_db = echo.sv_p95_db;
  row.sv_max_db = echo.sv_max_db;
}

}  // namespace

std::vector<bool> faulty_members(const MeasureInput& ping, const PingMask& mask) {
  std::vector<bool> faulty;
  faulty.reserve(mask.voxels());
  for (const Run& run : mask.runs) {
    const auto counts = ping.sv.row(run.row);
    const auto flags = ping.flags.row(run.row);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const auto i = static_cast<std::size_t>(s);
      faulty.push_back(is_faulty(flags[i], counts[i]));
    }
  }
  return faulty;
}

SchoolPingRow measure_row(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params) {
  SONAR_CHECK(ping.sector != nullptr && ping.grid != nullptr && !mask.empty());
  SONAR_CHECK(ping.sv.shape() == ping.flags.shape());
  SchoolPingRow row;
  count_voxels(mask, ping.sector->beams(), row);
  row.threshold_db = ping.threshold_db;
  const MaskShape shape = shape_of(mask, *ping.sector);
  row.volume_m3 = shape.volume_m3;
  const MaskEdges edges = mask_edges(mask, ping.flags, *ping.sector);
  row.edge_flags = edges.flags;
  row.edge_fraction = edges.edge_fraction;
  row.touches_edge = (edges.flags & kTouchesEdge) != 0 ? 1 : 0;
  if (!(shape.weight > 0.0)) return row;
  measure_place(ping, shape, row);
  measure_extents(ping, mask, shape, row);
  measure_echo(ping, mask, row);
  if (ping.seabed != nullptr) {
    // The seabed is a plane in the sector; its depth under the school is that of the levelled place.
    const double depth =
        bottom_depth_m(*ping.seabed, shape.centre, ping.placement, params.seabed_beyond_share, params.seabed_beyond_m);
    const Point<Sonar> bottom{shape.centre.x, shape.centre.y, depth - ping.placement.transducer_depth_m};
    row.bottom_depth_m = depth + (levelled(bottom, ping.placement).z - bottom.z);
  }
  describe_school(ping, mask, shape, row);
  return row;
}

MeasuredSchool measure(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params) {
  MeasuredSchool out;
  out.row = measure_row(ping, mask, params);
  // A range says that a voxel of the mask has a volume.
  if (!std::isfinite(out.row.range_m)) return out;
  const TotalEcho total = total_echo(ping, mask, ping.claims);
  out.row.backscatter_total_m2 = total.backscatter_m2;
  out.row.backscatter_total_se_m2 = total.se_m2;
  out.body = body_echo(ping, mask, params);
  return out;
}

}  // namespace sonar
