// SPDX-License-Identifier: Apache-2.0
#include "school/measure/describe_school.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "school/measure/echo_spread.h"
#include "school/measure/mask_inside.h"
#include "school/measure/nuclei.h"
#include "school/measure/oriented_box.h"
#include "school/measure/surface_area.h"
#include "school/runs.h"

namespace sonar {
namespace {

/// A surface of fewer beams or fans is the beam's.
constexpr int kLeastBeams = 3;

/// Surface of an ellipsoid whose half axes are as standard deviations are, within 1.1 %, for a volume.
/// source  Knud Thomsen's formula
double ellipsoid_m2(const std::array<double, 3>& variance, double volume_m3) {
  constexpr double kPower = 1.6075;
  const double a = std::pow(variance[0], kPower / 2.0);
  const double b = std::pow(variance[1], kPower / 2.0);
  const double c = std::pow(variance[2], kPower / 2.0);
  const double of_deviations = std::pow((a * b + a * c + b * c) / 3.0, 1.0 / kPower);
  const double product = std::sqrt(variance[0] * variance[1] * variance[2]);
  const double scale = std::cbrt(volume_m3 / (4.0 / 3.0 * std::numbers::pi * product));
  return 4.0 * std::numbers::pi * of_deviations * scale * scale;
}

double sphere_m2(double volume_m3) { return std::cbrt(36.0 * std::numbers::pi * volume_m3 * volume_m3); }

/// The mask with the water that it encloses.
std::vector<Run> filled(const PingMask& mask, const EnclosedWater& inside) {
  std::vector<Run> runs = mask.runs;
  runs.insert(runs.end(), inside.runs.begin(), inside.runs.end());
  std::sort(runs.begin(), runs.end());
  return merged_runs(runs);
}

void describe_form(const MeasureInput& ping, const PingMask& mask, const MaskShape& shape, const EnclosedWater& inside,
                   const std::vector<Run>& body, SchoolPingRow& row) {
  const PrincipalAxes axes = principal_axes(shape.covariance);
  const OrientedBox box = oriented_box(mask, axes, *ping.sector, ping.placement);
  row.box_length_m = box.length_m;
  row.box_width_m = box.width_m;
  row.box_thickness_m = box.thickness_m;
  row.box_bearing_deg = box.bearing_deg;
  row.box_tilt_deg = box.tilt_deg;
  row.area_m2 = area_from_above_m2(mask.runs, *ping.sector);
  row.equivalent_radius_m = std::cbrt(row.volume_m3 / (4.0 / 3.0 * std::numbers::pi));
  row.n_vacuoles = inside.vacuoles;
  row.vacuole_fraction = inside.vacuoles_m3 / (row.volume_m3 + inside.volume_m3);
  if (row.n_beams < kLeastBeams || row.n_fans < kLeastBeams) return;
  const double body_m3 = row.volume_m3 + inside.volume_m3;
  row.surface_m2 = surface_m2(body, *ping.sector);
  row.sphericity = sphere_m2(body_m3) / row.surface_m2;
  if (axes.variance[2] > 0.0) row.roughness = row.surface_m2 / ellipsoid_m2(axes.variance, body_m3);
}

void describe_echo(const MeasureInput& ping, const PingMask& mask, const std::vector<Run>& body, SchoolPingRow& row) {
  const double pulse_samples = ping.pulse_m / ping.sector->range().spacing_m;
  const int samples = std::max(1, static_cast<int>(std::ceil(pulse_samples)));
  const EchoSpread spread = echo_spread(ping, mask, core_runs(body, ping.sv.shape(), samples));
  row.sv_robust_mean_db = spread.robust_mean_db;
  row.sv_variation = spread.variation;
  row.sv_skewness = spread.skewness;
  row.sv_kurtosis = spread.kurtosis;
  row.core_edge_db = spread.core_edge_db;
  if (ping.filtered.data() != nullptr) {
    const int nuclei = count_nuclei(mask, ping.filtered);
    if (nuclei > 0) row.n_nuclei = nuclei;
  }
  const double nautical = 4.0 * std::numbers::pi * kMetresPerNauticalMile * kMetresPerNauticalMile;
  row.nasc_m2_nmi2 = nautical * row.backscatter_m2 / row.area_m2;
  if (!spread.centre) return;
  const Point<Sonar> centre = levelled(*spread.centre, ping.placement);
  const Geographic where = to_geographic(to_enu(centre, ping.placement.heading_rad), ping.placement.transducer);
  row.mass_latitude = where.latitude_deg;
  row.mass_longitude = where.longitude_deg;
  row.mass_depth_m = ping.placement.transducer_depth_m + centre.z;
}

void describe_resolution(const MeasureInput& ping, const PingMask& mask, const MaskShape& shape, SchoolPingRow& row) {
  const Sector& sector = *ping.sector;
  const IndexBox box = box_of(mask, sector.beams());
  const double across = sector.azimuth_bounds(box.last_beam).upper - sector.azimuth_bounds(box.first_beam).lower;
  const double upright = sector.elevation_bounds(box.last_fan).upper - sector.elevation_bounds(box.first_fan).lower;
  const double level = std::hypot(shape.centre.x, shape.centre.y) / norm(shape.centre);
  const auto beam = static_cast<std::size_t>(sector.row_towards(shape.centre));
  const double above_db = row.sv_mean_db - row.threshold_db;
  row.diner_nb_across =
      diner_relative_size(deg_from_rad(across) * level, ping.grid->horizontal_width_deg[beam], above_db);
  row.diner_nb_height = diner_relative_size(deg_from_rad(upright), ping.grid->vertical_width_deg[beam], above_db);
}

}  // namespace

double diner_relative_size(double extent_deg, double width_deg, double above_db) {
  if (!(above_db > 0.0) || !(width_deg > 0.0)) return kUnknown;
  const double beam_deg = 0.44 * width_deg * std::pow(above_db, 0.45);
  return std::tan(rad_from_deg(extent_deg) / 2.0) / std::tan(rad_from_deg(beam_deg) / 2.0);
}

void describe_school(const MeasureInput& ping, const PingMask& mask, const MaskShape& shape, SchoolPingRow& row) {
  const EnclosedWater inside = enclosed_water(mask, ping.flags, *ping.sector, ping.pulse_m);
  const std::vector<Run> body = filled(mask, inside);
  describe_form(ping, mask, shape, inside, body, row);
  describe_echo(ping, mask, body, row);
  describe_resolution(ping, mask, shape, row);
  const Point<Sonar> centre = levelled(shape.centre, ping.placement);
  row.horizontal_range_m = std::hypot(centre.x, centre.y);
  row.surface_distance_m = row.depth_min_m;
  row.bottom_distance_m = row.bottom_depth_m - row.depth_max_m;
}

}  // namespace sonar
