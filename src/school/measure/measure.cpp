// SPDX-License-Identifier: Apache-2.0
#include "school/measure/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/check.h"
#include "base/units.h"
#include "geo/geodesic.h"
#include "school/mask_shape.h"
#include "school/measure/body_echo.h"
#include "school/measure/edges.h"
#include "school/measure/total_echo.h"
#include "school/runs.h"

namespace sonar {
namespace {

double db_or_unknown(double linear) { return linear > 0.0 ? db_from_linear(linear) : kUnknown; }

struct Span {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  void add(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
  [[nodiscard]] double size() const { return most - least; }
};

/// Calls visit(corner) for the corners of the cells at both ends of each run: all others lie between.
template <class Visit>
void for_each_corner(const PingMask& mask, const Sector& sector, Visit visit) {
  const RangeAxis& axis = sector.range();
  for (const Run& run : mask.runs) {
    const AngleBounds e = sector.elevation_bounds(run.row / sector.beams());
    const AngleBounds a = sector.azimuth_bounds(run.row % sector.beams());
    const double near_m = std::max(axis.range_m(run.first_sample - 0.5), 0.0);
    const double far_m = std::max(axis.range_m(run.end() - 0.5), 0.0);
    for (const double elevation : {e.lower, e.upper}) {
      for (const double azimuth : {a.lower, a.upper}) {
        const Point<Sonar> u = Sector::direction(elevation, azimuth);
        visit(u * near_m);
        visit(u * far_m);
      }
    }
  }
}

void measure_place(const MeasureInput& ping, const MaskShape& shape, SchoolPingRow& row) {
  const Point<Sonar> centre = levelled(shape.centre, ping.placement);
  const Point<Enu> place = to_enu(centre, ping.placement.heading_rad);
  const Geographic where = to_geographic(place, ping.placement.transducer);
  row.latitude = where.latitude_deg;
  row.longitude = where.longitude_deg;
  row.depth_m = ping.placement.transducer_depth_m + centre.z;
  row.range_m = norm(shape.centre);
  row.bearing_deg = wrap_360(deg_from_rad(std::atan2(place.x, place.y)));
}

void measure_extents(const MeasureInput& ping, const PingMask& mask, const MaskShape& shape, SchoolPingRow& row) {
  const HorizontalAxes axes = horizontal_axes(shape.covariance, ping.placement.heading_rad);
  const double s = std::sin(axes.major_bearing_rad);
  const double c = std::cos(axes.major_bearing_rad);
  Span along;
  Span across;
  Span depth;
  for_each_corner(mask, *ping.sector, [&](const Point<Sonar>& in_sector) {
    const Point<Sonar> corner = levelled(in_sector, ping.placement);
    const Point<Enu> p = to_enu(corner, ping.placement.heading_rad);
    along.add(p.x * s + p.y * c);
    across.add(p.x * c - p.y * s);
    depth.add(ping.placement.transducer_depth_m + corner.z);
  });
  const bool swapped = across.size() > along.size();
  row.length_m = swapped ? across.size() : along.size();
  row.width_m = swapped ? along.size() : across.size();
  const double axis_deg = deg_from_rad(axes.major_bearing_rad) + (swapped ? 90.0 : 0.0);
  row.axis_deg = axis_deg >= 180.0 ? axis_deg - 180.0 : axis_deg;
  row.depth_min_m = depth.least;
  row.depth_max_m = depth.most;
  row.height_m = depth.size();
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

bool is_faulty(SampleFlags flags, std::int16_t count) { return any(flags & kFault) || count == kNoData; }

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

/// Echo of the valid members. The 95th percentile is the nearest rank over voxels.
void measure_echo(const MeasureInput& ping, const PingMask& mask, SchoolPingRow& row) {
  const Sector& sector = *ping.sector;
  double sum = 0.0;
  double noise = 0.0;
  double valid_m3 = 0.0;
  double whole_m3 = 0.0;  // summed in the same order, so that all valid is exactly 1
  CalibrationDoubt doubt(ping);
  std::vector<double> values;
  values.reserve(mask.voxels());
  for (const Run& run : mask.runs) {
    const auto counts = ping.sv.row(run.row);
    const auto flags = ping.flags.row(run.row);
    const RowBackground background(ping.background, run.row);
    const double solid_angle = sector.solid_angle_sr(run.row / sector.beams(), run.row % sector.beams());
    const std::size_t valid_before = values.size();
    double of_run = 0.0;
    for (int s = run.first_sample; s < run.end(); ++s) {
      const auto i = static_cast<std::size_t>(s);
      const double volume = solid_angle * sector.shell_m3_per_sr(s);
      whole_m3 += volume;
      if (is_faulty(flags[i], counts[i])) continue;
      const double behind = background(s);
      const double sv = linear_from_count(counts[i]) - behind;
      sum += sv * volume;
      of_run += sv * volume;
      noise += behind * volume;
      valid_m3 += volume;
      values.push_back(sv);
    }
    if (values.size() > valid_before) doubt.add(run.row, of_run);
  }
  row.valid_fraction = whole_m3 > 0.0 ? valid_m3 / whole_m3 : kUnknown;
  if (values.empty() || !(valid_m3 > 0.0)) return;
  const double mean = sum / valid_m3;
  row.sv_mean_db = db_or_unknown(mean);
  row.backscatter_m2 = mean * row.volume_m3;
  doubt.tell(row);
  row.snr_db = noise > 0.0 && sum > 0.0 ? db_from_linear(sum / noise) : kUnknown;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * static_cast<double>(values.size()))) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  row.sv_p95_db = db_or_unknown(values[static_cast<std::size_t>(rank)]);
  row.sv_max_db = db_or_unknown(*std::max_element(values.begin() + rank, values.end()));
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

MeasuredSchool measure(const MeasureInput& ping, const PingMask& mask, const MeasureParams& params) {
  SONAR_CHECK(ping.sector != nullptr && ping.grid != nullptr && !mask.empty());
  SONAR_CHECK(ping.sv.shape() == ping.flags.shape());
  MeasuredSchool out;
  SchoolPingRow& row = out.row;
  count_voxels(mask, ping.sector->beams(), row);
  row.threshold_db = ping.threshold_db;
  const MaskShape shape = shape_of(mask, *ping.sector);
  row.volume_m3 = shape.volume_m3;
  const MaskEdges edges = mask_edges(mask, ping.flags, *ping.sector);
  row.edge_flags = edges.flags;
  row.edge_fraction = edges.edge_fraction;
  row.touches_edge = (edges.flags & kTouchesEdge) != 0 ? 1 : 0;
  if (!(shape.weight > 0.0)) return out;
  measure_place(ping, shape, row);
  measure_extents(ping, mask, shape, row);
  measure_echo(ping, mask, row);
  const TotalEcho total = total_echo(ping, mask, ping.claims);
  row.backscatter_total_m2 = total.backscatter_m2;
  row.backscatter_total_se_m2 = total.se_m2;
  if (ping.seabed != nullptr) {
    // The seabed is a plane in the sector; its depth under the school is that of the levelled place.
    const double depth =
        bottom_depth_m(*ping.seabed, shape.centre, ping.placement, params.seabed_beyond_share, params.seabed_beyond_m);
    const Point<Sonar> bottom{shape.centre.x, shape.centre.y, depth - ping.placement.transducer_depth_m};
    row.bottom_depth_m = depth + (levelled(bottom, ping.placement).z - bottom.z);
  }
  out.body = body_echo(ping, mask, params);
  return out;
}

}  // namespace sonar
