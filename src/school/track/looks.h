// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geo/sector.h"
#include "school/track/motion.h"
#include "school/track/track.h"

namespace sonar {

/// One sighting of a tracked school, as the sightings near it look at it.
struct Look {
  PingMask mask;
  std::vector<const EchoPieces*> pieces{};  ///< of its detections, those that have some; borrowed
  PingFrame frame;
  double time_s = 0.0;
  Point<Enu> centre{};
  bool cut = false;  ///< by the sector's borders: its centre goes partly with the ship
};

/// [sighting] of a school.
[[nodiscard]] std::vector<Look> looks_of(const SchoolTrack& school, std::span<const DetectedPing> pings,
                                         const Sector& sector);

/// Median over whole sightings, so that masks that hold too much do not tell it; none where there are too few.
[[nodiscard]] std::optional<Point<Enu>> velocity_mps(std::span<const Look> looks);

/// A sighting that looks at another, and what it counts beside that one.
struct Neighbour {
  const Look* look = nullptr;
  double weight = 1.0;
};
/// The sightings near one, itself left out, nearest first; empty where all together count for too little.
[[nodiscard]] std::vector<Neighbour> neighbours_of(std::span<const Look> looks, std::size_t at);

/// A school's own echo in the pieces of one sighting: mean over this and its neighbours, looked at where the school swam to.
struct MeanEcho {
  IndexBox box;            ///< round all of the sighting's EchoPieces
  Array3<float> own_sv;    ///< [fan][beam][piece] m^-1; NaN = no school's in this sighting, or not known
  Array3<float> water_sv;  ///< same shape: the background

  /// NaN outside the box.
  [[nodiscard]] float own_at(int fan, int beam, int sample) const;
};
[[nodiscard]] MeanEcho mean_echo(const Look& here, std::span<const Neighbour> neighbours, const Point<Enu>& velocity,
                                 const Sector& sector);

}  // namespace sonar
