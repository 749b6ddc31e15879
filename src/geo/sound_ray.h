// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace sonar {

/// One line of a sound speed profile.
struct SoundSpeedAt {
  double depth_m = 0.0;
  double sound_speed_mps = 0.0;
  friend bool operator==(const SoundSpeedAt&, const SoundSpeedAt&) = default;
};
/// By rising depth. Between two lines the speed changes evenly; above the first line and below the last it stays.
using SoundProfile = std::vector<SoundSpeedAt>;

/// How far a ray has come.
struct RayPlace {
  double distance_m = 0.0;     ///< level, from where it began
  double depth_m = 0.0;        ///< positive down
  double elevation_rad = 0.0;  ///< of its way, positive up
  double sound_speed_mps = 0.0;
};

/// A ray of sound through layers in each of which the speed changes evenly with depth: in a layer it is an arc of a circle,
/// a straight line where the speed does not change, and it turns back where it lies level. With u = arsinh(tan dip), a
/// layer of gradient g takes u to u - g t in the time t, and distance, depth and time follow in closed form.
/// Surface and seabed turn no ray: beyond the profile it goes on straight.
/// source  Medwin & Clay 1998, Fundamentals of Acoustical Oceanography, section 3.3 (arcs in constant gradients)
class SoundRay {
 public:
  /// profile        not empty, rising; outlives the ray
  /// elevation_rad  -pi/2 .. pi/2, positive up
  SoundRay(const SoundProfile& profile, double depth_m, double elevation_rad);

  /// Goes on for a time, >= 0.
  void advance(double time_s);
  [[nodiscard]] RayPlace place() const;

 private:
  struct LayerEnd {
    double time_s;
    double tangent;
    bool down;
  };
  [[nodiscard]] double gradient(std::size_t layer) const;
  [[nodiscard]] LayerEnd layer_end() const;
  void begin_on_line(std::size_t line);
  void move(double time_s);
  void cross(const LayerEnd& through);

  const SoundProfile& profile_;
  std::size_t layer_ = 0;  ///< between lines layer_ - 1 and layer_
  bool level_ = false;     ///< it lies level where neither side bends it away
  double tangent_ = 0.0;   ///< of the dip, positive down
  double speed_mps_ = 0.0;
  RayPlace at_;
};

}  // namespace sonar
