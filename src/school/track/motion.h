// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "geo/frames.h"
#include "school/mask_shape.h"

namespace sonar {

/// Where a ping stands in a frame common to many: east, north, up about the first ping's place at the water line.
class PingFrame {
 public:
  PingFrame(const Placement& placement, const Geographic& origin);
  [[nodiscard]] Point<Enu> to_world(const Point<Sonar>& p) const;
  [[nodiscard]] Point<Sonar> from_world(const Point<Enu>& p) const;
  [[nodiscard]] double heading_rad() const { return placement_.heading_rad; }

 private:
  Placement placement_;
  Point<Enu> transducer_;
};

/// A covariance turned from the sonar frame to east, north, up.
[[nodiscard]] Covariance3 turned(const Covariance3& sonar, double heading_rad);

/// How well a mask's centre tells the school's: a share of its extent, and nothing in directions where a border of the
/// sector cuts it off (censored coordinates).
/// censored_m  standard deviation of a coordinate that is cut off
/// edge_flags  EdgeFlags; censored = false leaves them out
[[nodiscard]] Covariance3 centre_covariance(const Point<Sonar>& centre, const Covariance3& shape, double heading_rad,
                                            double share, double least_m, double censored_m, std::int32_t edge_flags);

/// Kalman filter of a point with nearly constant velocity.
class Motion {
 public:
  Motion(const Point<Enu>& position, const Covariance3& position_covariance, double speed_spread_mps);

  void predict(double seconds, double acceleration_mps2);
  void update(const Point<Enu>& position, const Covariance3& covariance);
  /// Squared Mahalanobis distance of a position; infinite where the covariance is degenerate.
  [[nodiscard]] double distance2(const Point<Enu>& position, const Covariance3& covariance) const;

  [[nodiscard]] Point<Enu> position() const { return {state_[0], state_[1], state_[2]}; }
  [[nodiscard]] Point<Enu> velocity() const { return {state_[3], state_[4], state_[5]}; }

 private:
  using Matrix3 = std::array<std::array<double, 3>, 3>;
  [[nodiscard]] bool inverse_innovation(const Covariance3& covariance, Matrix3& inverse) const;

  std::array<double, 6> state_{};
  std::array<std::array<double, 6>, 6> p_{};
};

}  // namespace sonar
