// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geo/frames.h"

namespace sonar {

/// Slant ranges of the samples of a beam; sample i lies at first_m + i * spacing_m (may be negative for the first
/// ones).
struct RangeAxis {
  double first_m = 0.0;
  double spacing_m = 1.0;
  int count = 0;

  [[nodiscard]] double range_m(double sample) const { return first_m + sample * spacing_m; }
  [[nodiscard]] double sample_at(double range_m) const { return (range_m - first_m) / spacing_m; }
  friend bool operator==(const RangeAxis&, const RangeAxis&) = default;
};

/// Bounds of an angular cell, radians.
struct AngleBounds {
  double lower = 0.0;
  double upper = 0.0;
};

/// A place in the sector in units of fans, beams and samples; whole numbers are beam centres and sample centres.
struct SectorIndex {
  double fan = 0.0;
  double beam = 0.0;
  double sample = 0.0;
};

/// The sonar's sector: a product grid of elevations and azimuths, cut into cells that tile it without gap or overlap.
/// Cells reach half way to the neighbouring beams; the outermost extend half a spacing beyond their beam; a direction
/// with a single beam takes the widths given.
class Sector {
 public:
  Sector() = default;
  /// elevation_rad  [fan], strictly rising, positive up
  /// azimuth_rad    [beam], strictly rising (unwrapped), clockwise from the bow
  /// lone_*_rad     full width of the cell where there is only one fan or one beam
  Sector(std::vector<double> elevation_rad, std::vector<double> azimuth_rad, RangeAxis range,
         double lone_elevation_width_rad = 0.12, double lone_azimuth_width_rad = 0.06);

  [[nodiscard]] int fans() const { return static_cast<int>(elevation_rad_.size()); }
  [[nodiscard]] int beams() const { return static_cast<int>(azimuth_rad_.size()); }
  [[nodiscard]] const RangeAxis& range() const { return range_; }
  [[nodiscard]] double elevation_rad(int fan) const { return elevation_rad_[static_cast<std::size_t>(fan)]; }
  [[nodiscard]] double azimuth_rad(int beam) const { return azimuth_rad_[static_cast<std::size_t>(beam)]; }
  [[nodiscard]] AngleBounds elevation_bounds(int fan) const { return elevation_bounds_[static_cast<std::size_t>(fan)]; }
  [[nodiscard]] AngleBounds azimuth_bounds(int beam) const { return azimuth_bounds_[static_cast<std::size_t>(beam)]; }

  /// Unit vector along an elevation and azimuth.
  [[nodiscard]] static Point<Sonar> direction(double elevation_rad, double azimuth_rad);
  /// Centre of a voxel.
  [[nodiscard]] Point<Sonar> centre(int fan, int beam, int sample) const;

  /// d_azimuth * |sin e2 - sin e1|, sr.
  [[nodiscard]] double solid_angle_sr(int fan, int beam) const;
  /// (r2^3 - r1^3)/3 of a sample's shell; 0 where the range is below one spacing.
  [[nodiscard]] double shell_m3_per_sr(int sample) const { return shell_[static_cast<std::size_t>(sample)]; }
  /// Volume of a voxel's cell, m^3.
  [[nodiscard]] double volume_m3(int fan, int beam, int sample) const {
    return solid_angle_sr(fan, beam) * shell_m3_per_sr(sample);
  }

  /// Fractional index of a place; outside the beam centres it extrapolates with the outermost spacing.
  [[nodiscard]] SectorIndex index_of(const Point<Sonar>& p) const;
  /// Row, fan x beams + beam, of the beam whose cell holds a place's direction; outside, of the outermost on that side.
  [[nodiscard]] int row_towards(const Point<Sonar>& p) const;
  /// Where a fractional index lies, outside as index_of() has it; a range below 0 counts as 0.
  [[nodiscard]] Point<Sonar> place_at(const SectorIndex& index) const;
  /// Whether an index lies in a cell of the sector.
  [[nodiscard]] bool contains(const SectorIndex& index) const;

 private:
  std::vector<double> elevation_rad_;
  std::vector<double> azimuth_rad_;
  RangeAxis range_;
  std::vector<AngleBounds> elevation_bounds_;
  std::vector<AngleBounds> azimuth_bounds_;
  std::vector<double> shell_;
};

}  // namespace sonar
