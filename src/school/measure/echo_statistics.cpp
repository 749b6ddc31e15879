// SPDX-License-Identifier: Apache-2.0
#include "school/measure/echo_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"
#include "school/measure/mask_corners.h"

namespace sonar {
namespace {

double db_or_unknown(double linear) { return linear > 0.0 ? db_from_linear(linear) : kUnknown; }

/// Levels that so many of the values do not surpass, by partial sorting from above.
void rank_levels(std::vector<double>& values, EchoStatistics& out) {
  const auto rank = [&](double share) {
    return static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
  };
  auto end = values.end();
  const auto level = [&](double share) {
    const auto at = values.begin() + rank(share);
    if (at < end) std::nth_element(values.begin(), at, end);
    end = at;
    return db_or_unknown(*at);
  };
  out.sv_p95_db = level(0.95);
  out.sv_max_db = db_or_unknown(*std::max_element(end, values.end()));
  out.sv_p50_db = level(0.50);
  out.sv_p5_db = level(0.05);
}

}  // namespace

bool is_faulty(SampleFlags flags, std::int16_t count) { return any(flags & kFault) || count == kNoData; }

EchoStatistics echo_statistics(const MeasureInput& ping, const PingMask& mask,
                               const std::function<void(int row, double echo_m2)>& each_run) {
  const Sector& sector = *ping.sector;
  EchoStatistics out;
  double sum = 0.0;
  double noise = 0.0;
  std::vector<double> values;
  values.reserve(mask.voxels());
  for (const Run& run : mask.runs) {
    const auto counts = ping.sv.row(run.row);
    const auto flags = ping.flags.row(run.row);
    const RowBackground background(ping.background, run.row);
    const double solid_angle = sector.solid_angle_sr(run.row / sector.beams(), run.row % sector.beams());
    const std::size_t heard_before = values.size();
    double of_run = 0.0;
    for (int s = run.first_sample; s < run.end(); ++s) {
      const auto i = static_cast<std::size_t>(s);
      const double volume = solid_angle * sector.shell_m3_per_sr(s);
      out.volume_m3 += volume;  // in the order of heard_m3, so that all heard is exactly all
      if (is_faulty(flags[i], counts[i])) continue;
      const double behind = background(s);
      const double sv = linear_from_count(counts[i]) - behind;
      sum += sv * volume;
      of_run += sv * volume;
      noise += behind * volume;
      out.heard_m3 += volume;
      values.push_back(sv);
    }
    out.voxels += run.count;
    if (each_run && values.size() > heard_before) each_run(run.row, of_run);
  }
  out.heard = static_cast<std::int64_t>(values.size());
  if (values.empty() || !(out.heard_m3 > 0.0)) return out;
  out.mean_sv_per_m = sum / out.heard_m3;
  out.sv_mean_db = db_or_unknown(out.mean_sv_per_m);
  out.backscatter_m2 = out.mean_sv_per_m * out.volume_m3;
  out.snr_db = noise > 0.0 && sum > 0.0 ? db_from_linear(sum / noise) : kUnknown;
  rank_levels(values, out);
  return out;
}

MaskExtents mask_extents(const PingMask& mask, const Covariance3& covariance, const Sector& sector,
                         const Placement& placement) {
  const HorizontalAxes axes = horizontal_axes(covariance, placement.heading_rad);
  const double s = std::sin(axes.major_bearing_rad);
  const double c = std::cos(axes.major_bearing_rad);
  Extent along;
  Extent across;
  Extent depth;
  Extent range;
  for_each_corner(mask, sector, [&](const Point<Sonar>& in_sector) {
    const Point<Sonar> corner = levelled(in_sector, placement);
    const Point<Enu> p = to_enu(corner, placement.heading_rad);
    along.add(p.x * s + p.y * c);
    across.add(p.x * c - p.y * s);
    depth.add(placement.transducer_depth_m + corner.z);
    range.add(norm(in_sector));
  });
  const bool swapped = across.size() > along.size();
  const double axis_deg = deg_from_rad(axes.major_bearing_rad) + (swapped ? 90.0 : 0.0);
  MaskExtents out;
  out.length_m = swapped ? across.size() : along.size();
  out.width_m = swapped ? along.size() : across.size();
  out.axis_deg = axis_deg >= 180.0 ? axis_deg - 180.0 : axis_deg;
  out.depth_min_m = depth.least;
  out.depth_max_m = depth.most;
  out.range_min_m = range.least;
  out.range_max_m = range.most;
  return out;
}

}  // namespace sonar
