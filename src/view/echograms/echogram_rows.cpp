// SPDX-License-Identifier: Apache-2.0
#include "view/echograms/echogram_rows.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace sonar {
namespace {

/// A beam that looks along the surface has all its samples at one depth: bins are no finer than this.
constexpr double kLeastBin_m = 0.01;

}  // namespace

std::vector<EchogramRow> echogram_rows(const Sector& sector, const Placement& placement, const EchogramOf& of) {
  SONAR_CHECK(!of.fan || (*of.fan >= 0 && *of.fan < sector.fans()));
  SONAR_CHECK(!of.beam || (of.fan && *of.beam >= 0 && *of.beam < sector.beams()));
  std::vector<EchogramRow> rows;
  const RangeAxis& range = sector.range();
  const int last_fan = of.fan ? *of.fan + 1 : sector.fans();
  const int last_beam = of.beam ? *of.beam + 1 : sector.beams();
  for (int fan = of.fan.value_or(0); fan < last_fan; ++fan) {
    for (int beam = of.beam.value_or(0); beam < last_beam; ++beam) {
      EchogramRow row{fan * sector.beams() + beam, range.first_m, range.spacing_m};
      if (of.height == EchogramHeight::depth) {
        const Point<Sonar> along = Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam));
        const double down = levelled_direction(along, placement).z;
        row.first_m = placement.transducer_depth_m + down * range.first_m;
        row.step_m = down * range.spacing_m;
      }
      rows.push_back(row);
    }
  }
  return rows;
}

EchogramRange echogram_range(const Sector& sector, std::span<const Placement> pings, const EchogramOf& of, int most) {
  const RangeAxis& axis = sector.range();
  const int count = std::max(1, axis.count);
  EchogramRange out;
  double deepest_m = 0.0;
  if (of.height == EchogramHeight::range) {
    out.bin_m = axis.spacing_m;
    // The first bin whose sample lies in front of the transducer; half a bin before it.
    const double behind = std::ceil(std::max(0.0, -axis.first_m) / axis.spacing_m - 1e-6);
    out.first_m = axis.first_m + (behind - 0.5) * axis.spacing_m;
    deepest_m = axis.range_m(count - 0.5);
  } else {
    double widest_m = kLeastBin_m;
    for (const Placement& ping : pings) {
      for (const EchogramRow& row : echogram_rows(sector, ping, of)) {
        widest_m = std::max(widest_m, std::abs(row.step_m));
        deepest_m = std::max({deepest_m, row.height_m(0), row.height_m(count - 1)});
      }
    }
    deepest_m += widest_m;
    out.bin_m = widest_m;
    out.first_m = 0.0;
  }
  const double length_m = std::max(out.bin_m, deepest_m - out.first_m);
  const int bins = std::max(1, static_cast<int>(std::ceil(length_m / out.bin_m - 1e-6)));
  out.bins = std::clamp(bins, 1, std::max(1, most));
  if (out.bins < bins) out.bin_m = length_m / out.bins;
  return out;
}

std::vector<EchogramCell> echogram_column(const Sector& sector, View3<const std::int16_t> sv,
                                          View3<const SampleFlags> flags, SampleFlags hidden,
                                          std::span<const EchogramRow> rows, const EchogramRange& range) {
  const Shape3& shape = sv.shape();
  SONAR_CHECK(shape == flags.shape() && shape.fans == sector.fans() && shape.beams == sector.beams());
  const int samples = std::min(shape.samples, sector.range().count);
  EchogramColumn column(range, samples);
  std::vector<double> volumes(static_cast<std::size_t>(std::max(0, samples)));
  for (const EchogramRow& one : rows) {
    const int fan = one.row / shape.beams;
    const int beam = one.row % shape.beams;
    for (int s = 0; s < samples; ++s) volumes[static_cast<std::size_t>(s)] = sector.volume_m3(fan, beam, s);
    column.lay(one.first_m, one.step_m);
    column.add({sv.row(fan, beam), flags.row(fan, beam), volumes}, hidden);
  }
  return column.cells();
}

}  // namespace sonar
