// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "view/image.h"
#include "view/slices/slice.h"

namespace sonar {

/// Whether two sectors have the same cells.
[[nodiscard]] bool same_cells(const Sector& a, const Sector& b);

/// Right times down of a plane: away from the viewer, a unit vector.
[[nodiscard]] Point<Sonar> normal_of(const PlaneSlice& plane);

/// The plane of a slice as it lies on the picture: a horizontal one turned until `up_rad` points up.
[[nodiscard]] PlaneSlice turned_plane(const SliceView& view);

/// Slice coordinates to voxels and back, for one sector and one slice. Cells hold their lower bound and not their upper
/// one; the outermost hold both.
class SliceGeometry {
 public:
  /// Borrows the sector.
  SliceGeometry(const Sector& sector, const SliceView& view);

  [[nodiscard]] std::optional<Voxel> voxel(double x, double y) const;
  /// See SliceMap::place_of.
  [[nodiscard]] std::optional<PixelPoint> place(const Voxel& voxel) const;
  [[nodiscard]] Point<Sonar> point(double x, double y) const;

  /// -1 = none. beam_at() takes azimuths of any turn, beam_on_axis() only those of the sector itself.
  [[nodiscard]] int fan_at(double elevation_rad) const;
  [[nodiscard]] int beam_at(double azimuth_rad) const;
  [[nodiscard]] int beam_on_axis(double azimuth_rad) const;
  [[nodiscard]] const std::vector<double>& elevation_edges() const { return elevation_edges_; }  ///< [fan + 1], rad
  [[nodiscard]] const std::vector<double>& azimuth_edges() const { return azimuth_edges_; }      ///< [beam + 1], rad

 private:
  [[nodiscard]] int sample_at(double range_m) const;
  [[nodiscard]] std::optional<Voxel> checked(int fan, int beam, int sample) const;
  [[nodiscard]] std::optional<Voxel> voxel_of(const Point<Sonar>& p) const;
  [[nodiscard]] std::optional<PixelPoint> place_on_plane(const Voxel& voxel) const;

  const Sector* sector_;
  Slice slice_;
  PlaneSlice plane_;
  double up_rad_ = 0.0;
  std::vector<double> elevation_edges_;  ///< [fan + 1], rad
  std::vector<double> azimuth_edges_;    ///< [beam + 1], rad
};

}  // namespace sonar
