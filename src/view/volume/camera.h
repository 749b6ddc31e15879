// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "geo/frames.h"
#include "geo/sector.h"
#include "view/image.h"

namespace sonar {

/// A perspective camera in the sonar frame (x bow, y starboard, z down; metres). Up is against z unless said otherwise.
struct Camera {
  Point<Sonar> eye{0.0, 0.0, -100.0};
  Point<Sonar> target{0.0, 0.0, 0.0};
  Point<Sonar> up{0.0, 0.0, -1.0};
  double vertical_fov_rad = 0.6108652381980153;  ///< 35 degrees
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// A straight ray; `direction` has length 1, so that a ray's parameter is metres from the eye.
struct Ray {
  Point<Sonar> origin;
  Point<Sonar> direction;
};

/// A camera made ready for a picture: an orthonormal basis and the scale of a pixel.
struct CameraBasis {
  Point<Sonar> eye;
  Point<Sonar> right;  ///< unit vectors
  Point<Sonar> up;
  Point<Sonar> forward;
  double tan_half_fov = 1.0;  ///< of the vertical field of view
  PixelSize size;

  /// Ray through a place of the picture.
  [[nodiscard]] Ray ray(PixelPoint pixel) const;
  /// Where a point appears, with its distance along `forward`; empty behind the eye.
  struct Projected {
    PixelPoint pixel;
    double depth_m = 0.0;
  };
  [[nodiscard]] std::optional<Projected> project(const Point<Sonar>& point) const;
};

/// A degenerate camera (eye at target, or looking along `up`) gets some sound basis.
[[nodiscard]] CameraBasis basis(const Camera& camera, PixelSize size);

/// Turns about the target: azimuth about the vertical, elevation towards the vertical (kept 1 degree off it).
[[nodiscard]] Camera orbited(const Camera& camera, double azimuth_rad, double elevation_rad);
/// Moves eye and target sideways, in fractions of the picture's height.
[[nodiscard]] Camera panned(const Camera& camera, double right, double up);
/// Distance to the target times `factor` (> 0).
[[nodiscard]] Camera zoomed(const Camera& camera, double factor);

/// Eye and target come `factor` (> 0) times as far from a place, which stays where it is in the picture.
[[nodiscard]] Camera zoomed_about(const Camera& camera, const Point<Sonar>& about, double factor);

/// Sees the whole sector from a side, as large as a picture of this shape allows.
/// from  unit vector towards the eye, not along the vertical
[[nodiscard]] Camera seen_from(const Sector& sector, const Point<Sonar>& from, PixelSize size);

/// Sees the whole sector, obliquely from above and from outside, as large as a picture of this shape allows.
[[nodiscard]] Camera overview(const Sector& sector, PixelSize size = {1024, 768});

}  // namespace sonar
