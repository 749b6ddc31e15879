// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/mask.h"

namespace sonar {

/// Symmetric 3 x 3: xx, xy, xz, yy, yz, zz.
using Covariance3 = std::array<double, 6>;
using Vector3 = std::array<double, 3>;

/// sum += weight x v v^T
void add_square(Covariance3& sum, const Vector3& v, double weight);

/// A mask as a body, weighted by confidence x volume.
struct MaskShape {
  Point<Sonar> centre;       ///< m
  Covariance3 covariance{};  ///< of the members round the centre, m^2
  double weight = 0.0;       ///< sum of confidence (0..1) x volume; 0 = centre and covariance mean nothing
  double volume_m3 = 0.0;    ///< sum of member cells
};
[[nodiscard]] MaskShape shape_of(const PingMask& mask, const Sector& sector);

/// Axes along which a covariance has no mixed terms.
struct PrincipalAxes {
  std::array<double, 3> variance{};  ///< falling
  std::array<Vector3, 3> axis{};     ///< unit vectors, each square to the others
};
/// source  Jacobi's method (Golub & Van Loan, Matrix Computations, section 8.5)
[[nodiscard]] PrincipalAxes principal_axes(const Covariance3& covariance);

/// The horizontal part of a covariance of the sonar frame, turned to east and north.
struct HorizontalAxes {
  double major_variance = 0.0;
  double minor_variance = 0.0;
  double major_bearing_rad = 0.0;  ///< clockwise from north, 0..pi
};
[[nodiscard]] HorizontalAxes horizontal_axes(const Covariance3& covariance, double heading_rad);

}  // namespace sonar
