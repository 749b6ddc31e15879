// SPDX-License-Identifier: Apache-2.0
#include "view/echograms/echogram_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.h"

namespace sonar {
namespace {

/// A beam that looks along the surface has all its samples at one depth: bins are no finer than this.
constexpr double kLeastBin_m = 0.01;

/// Pieces of a bent beam: an arc of 150 m radius, as in a thermocline of 10 m/s each metre, is off its chord by 5 cm
/// where pieces are 8 m long, of a beam of 2 km.
constexpr int kPieces = 256;

}  // namespace

double EchogramRow::height_m(double sample) const {
  const double at = sample / apart;
  const double last = static_cast<double>(heights_m.size() - 2);
  const double piece = std::clamp(std::floor(at), 0.0, last);
  const auto i = static_cast<std::size_t>(piece);
  return heights_m[i] + (at - piece) * (heights_m[i + 1] - heights_m[i]);
}

std::optional<double> EchogramRow::sample_at(double height_m) const {
  const double half = 0.5 / apart;  // the outermost cells reach beyond their samples
  const std::size_t last = heights_m.size() - 2;
  for (std::size_t i = 0; i <= last; ++i) {
    // On a level piece all samples lie there or none: the quotient is no number, or infinite.
    const double along = (height_m - heights_m[i]) / (heights_m[i + 1] - heights_m[i]);
    if (along >= (i == 0 ? -half : 0.0) && along <= (i == last ? 1.0 + half : 1.0)) {
      return (static_cast<double>(i) + along) * apart;
    }
  }
  return std::nullopt;
}

std::vector<EchogramRow> echogram_rows(const Sector& sector, const Placement& placement, const EchogramOf& of) {
  SONAR_CHECK(!of.fan || (*of.fan >= 0 && *of.fan < sector.fans()));
  SONAR_CHECK(!of.beam || (of.fan && *of.beam >= 0 && *of.beam < sector.beams()));
  std::vector<EchogramRow> rows;
  const RangeAxis& range = sector.range();
  const bool deep = of.height == EchogramHeight::depth;
  const int pieces = deep && placement.rays ? kPieces : 1;
  const double apart = std::max(1.0, range.count - 1.0) / pieces;
  const int last_fan = of.fan ? *of.fan + 1 : sector.fans();
  const int last_beam = of.beam ? *of.beam + 1 : sector.beams();
  for (int fan = of.fan.value_or(0); fan < last_fan; ++fan) {
    for (int beam = of.beam.value_or(0); beam < last_beam; ++beam) {
      const Point<Sonar> along = Sector::direction(sector.elevation_rad(fan), sector.azimuth_rad(beam));
      EchogramRow row{fan * sector.beams() + beam, apart, {}};
      for (int i = 0; i <= pieces; ++i) {
        const double range_m = range.range_m(i * apart);
        row.heights_m.push_back(deep ? placement.transducer_depth_m + levelled(along * range_m, placement).z : range_m);
      }
      rows.push_back(std::move(row));
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
        deepest_m = std::max(deepest_m, std::ranges::max(row.heights_m));
        for (std::size_t i = 1; i < row.heights_m.size(); ++i) {
          widest_m = std::max(widest_m, std::abs(row.heights_m[i] - row.heights_m[i - 1]) / row.apart);
        }
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
  std::vector<double> heights(volumes.size());
  for (const EchogramRow& one : rows) {
    const int fan = one.row / shape.beams;
    const int beam = one.row % shape.beams;
    for (int s = 0; s < samples; ++s) {
      volumes[static_cast<std::size_t>(s)] = sector.volume_m3(fan, beam, s);
      heights[static_cast<std::size_t>(s)] = one.height_m(s);
    }
    column.lay(heights);
    column.add({sv.row(fan, beam), flags.row(fan, beam), volumes}, hidden);
  }
  return column.cells();
}

}  // namespace sonar
