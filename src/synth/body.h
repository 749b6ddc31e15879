// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "geo/frames.h"

namespace sonar::synth {

/// A nucleus (denser than the body) or a vacuole (empty) inside a body. Places and radius are fractions of the body's
/// half axes, so that a lump of radius 1 at 0, 0, 0 fills the body.
struct Lump {
  double along = 0.0;
  double across = 0.0;
  double up = 0.0;
  double radius = 0.2;
  double excess_db = 6.0;  ///< at its centre, falling off as a Gaussian; -infinity = a vacuole with a sharp edge
};
inline constexpr double kVacuole = -std::numeric_limits<double>::infinity();

/// A school's body: an ellipsoid with a ragged boundary.
struct BodyShape {
  double length_m = 40.0;  ///< full axes
  double width_m = 25.0;
  double height_m = 10.0;
  double axis_deg = 0.0;    ///< bearing of the length, clockwise from north
  double sv_db = -40.0;     ///< of the body between its nuclei
  double raggedness = 0.0;  ///< the boundary wanders by this fraction of the half axes
  double ragged_scale_m = 8.0;
  std::vector<Lump> lumps;
  std::uint64_t seed = 0;  ///< of the ragged boundary and the scatterers' places
};

/// A body and how it moves, in east, north, up about the scene's origin at the mean sea surface (z = -depth).
struct Body {
  int school_id = 1;
  BodyShape shape;
  Point<Enu> centre_m;      ///< at the scene's first ping
  Point<Enu> velocity_mps;  ///< over ground
  // A school that splits is two bodies with one id that part: from then on this one has an id of its own.
  double splits_at_s = std::numeric_limits<double>::infinity();  ///< since the first ping
  int id_after_split = 0;                                        ///< 0 = keeps its id
  Point<Enu> split_velocity_mps;                                 ///< added from then on

  [[nodiscard]] Point<Enu> centre_at(double seconds) const;
  [[nodiscard]] Point<Enu> velocity_at(double seconds) const;
  [[nodiscard]] int id_at(double seconds) const;
};

/// A small volume of a body that scatters as one.
struct Scatterer {
  Point<Enu> offset_m;        ///< from the body's centre
  double backscatter_m2 = 0;  ///< sv x volume
};

/// A body cut into scatterers: one at a random place of every cell of a cubic lattice that lies inside.
struct Scatterers {
  std::vector<Scatterer> points;
  double cell_m3 = 0.0;
  double volume_m3 = 0.0;       ///< cells inside, vacuoles left out
  double backscatter_m2 = 0.0;  ///< sum of sv V
  double length_m = 0.0;        ///< full extents along the body's own axes
  double width_m = 0.0;
  double height_m = 0.0;
  double reach_m = 0.0;  ///< largest distance of a scatterer from the centre
};
[[nodiscard]] Scatterers scatterers(const BodyShape& shape);

}  // namespace sonar::synth
