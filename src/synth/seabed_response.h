// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geo/frames.h"
#include "synth/layout.h"
#include "synth/scene.h"
#include "synth/terrain.h"

namespace sonar::synth {

/// The seabed of one ping, seen by every beam through its pattern: a plane by formula, relief by its lit patches.
class Seabed {
 public:
  /// ship  where the transducer is in the scene's frame
  Seabed(const Layout& layout, const Scene& scene, const Point<Enu>& ship, double heading_rad);

  /// Expected sv in a voxel; 0 where the pattern does not reach it.
  [[nodiscard]] double sv(int row, int sample) const;
  /// Samples of a row with an echo: [first, last).
  [[nodiscard]] int first_sample(int row) const { return rows_[static_cast<std::size_t>(row)].first; }
  [[nodiscard]] int last_sample(int row) const { return rows_[static_cast<std::size_t>(row)].last; }
  /// First sample that the truth counts as seabed: where the lower -3 dB edge meets it, one pulse earlier.
  [[nodiscard]] int limit(int row) const { return rows_[static_cast<std::size_t>(row)].limit; }
  /// Depth of the seabed below the sea surface under the ship.
  [[nodiscard]] double depth_m() const { return depth_m_; }

 private:
  struct Row {
    double slope_rad = 0.0;   ///< of the plane along the beam, positive = deeper
    double distance_m = 0.0;  ///< shortest way to the plane in the beam's vertical plane
    int first = 0;
    int last = 0;
    int limit = 0;
    std::vector<float> sv;  ///< [first, last) over relief
  };
  void see_plane(const Scene& scene, double heading_rad);
  void see_relief(const Scene& scene, const Terrain& terrain, const Point<Enu>& ship, double heading_rad);
  [[nodiscard]] int sample_of(double range_m, int count) const;
  [[nodiscard]] double plane_sv(const Row& plane, const RowBeam& beam, int sample) const;

  const Layout& layout_;
  double strength_ = 0.0;
  double depth_m_ = 0.0;
  std::vector<Row> rows_;
};

}  // namespace sonar::synth
