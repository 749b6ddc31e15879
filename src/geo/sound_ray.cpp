// SPDX-License-Identifier: Apache-2.0
#include "geo/sound_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/check.h"

namespace sonar {
namespace {

/// Steeper than any beam tells, and its square is still a number.
constexpr double kSteepest = 1e8;
/// s^-1; bends by less than a micrometre over a sonar's range.
constexpr double kNoGradient = 1e-9;

/// sinh(g t) / g.
double sinh_over(double g, double t) { return g * t == 0.0 ? t : std::sinh(g * t) / g; }

}  // namespace

SoundRay::SoundRay(const SoundProfile& profile, double depth_m, double elevation_rad) : profile_(profile) {
  SONAR_CHECK(!profile.empty());
  const double steep = std::numbers::pi / 2 - std::abs(elevation_rad);
  tangent_ = steep > 1.0 / kSteepest ? -std::tan(elevation_rad) : std::copysign(kSteepest, -elevation_rad);
  at_.depth_m = depth_m;
  const auto below = std::lower_bound(profile.begin(), profile.end(), depth_m,
                                      [](const SoundSpeedAt& line, double depth) { return line.depth_m < depth; });
  layer_ = static_cast<std::size_t>(below - profile.begin());
  const bool on_line = below != profile.end() && below->depth_m == depth_m;
  const SoundSpeedAt& near = below == profile.end() ? profile.back() : *below;
  speed_mps_ = near.sound_speed_mps + gradient(layer_) * (depth_m - near.depth_m);
  if (on_line) begin_on_line(layer_);
}

double SoundRay::gradient(std::size_t layer) const {
  if (layer == 0 || layer == profile_.size()) return 0.0;
  const SoundSpeedAt& top = profile_[layer - 1];
  const SoundSpeedAt& bottom = profile_[layer];
  const double g = (bottom.sound_speed_mps - top.sound_speed_mps) / (bottom.depth_m - top.depth_m);
  return std::abs(g) < kNoGradient ? 0.0 : g;
}

/// Chooses the layer in which a ray goes on from a line: a level one is bent to where sound is slower.
void SoundRay::begin_on_line(std::size_t line) {
  const bool down = tangent_ > 0.0 || (tangent_ == 0.0 && gradient(line + 1) < 0.0);
  layer_ = down ? line + 1 : line;
  level_ = tangent_ == 0.0 && !down && !(gradient(line) > 0.0);
}

/// The end of the layer that the ray comes to, when, and how steep it is there. Never, where it does not.
SoundRay::LayerEnd SoundRay::layer_end() const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double g = gradient(layer_);
  const double to_top_m = layer_ > 0 ? profile_[layer_ - 1].depth_m - at_.depth_m : -kNever;
  const double to_bottom_m = layer_ < profile_.size() ? profile_[layer_].depth_m - at_.depth_m : kNever;
  if (g == 0.0) {
    const double falling_mps = speed_mps_ * tangent_ / std::hypot(1.0, tangent_);
    if (level_ || falling_mps == 0.0) return {kNever, tangent_, false};
    const bool down = falling_mps > 0.0;
    return {std::max((down ? to_bottom_m : to_top_m) / falling_mps, 0.0), tangent_, down};
  }
  if (level_) return {kNever, tangent_, false};
  // Snell: cosh u goes as 1 / c; negative where it turns before it comes there.
  const auto square_at = [&](double to_m) {
    const double there_mps = speed_mps_ + g * to_m;
    const double square = tangent_ * speed_mps_ * tangent_ * speed_mps_ - g * to_m * (speed_mps_ + there_mps);
    return square / (there_mps * there_mps);
  };
  bool down = tangent_ > 0.0 || (tangent_ == 0.0 && g < 0.0);
  double square = square_at(down ? to_bottom_m : to_top_m);
  if (square < 0.0) {
    down = !down;
    square = std::max(square_at(down ? to_bottom_m : to_top_m), 0.0);
  }
  const double tangent = down ? std::sqrt(square) : -std::sqrt(square);
  return {std::max((std::asinh(tangent_) - std::asinh(tangent)) / g, 0.0), tangent, down};
}

void SoundRay::move(double time_s) {
  const double g = level_ ? 0.0 : gradient(layer_);
  const double u = std::asinh(tangent_);
  const double after = u - g * time_s;
  const double flat = 1.0 / std::cosh(after);
  at_.distance_m += speed_mps_ * sinh_over(g, time_s) * flat;
  const double down_m = 2.0 * speed_mps_ * sinh_over(g, time_s / 2) * std::sinh(u - g * time_s / 2) * flat;
  at_.depth_m += down_m;
  speed_mps_ += g * down_m;
  if (g != 0.0) tangent_ = std::sinh(after);
}

void SoundRay::cross(const LayerEnd& through) {
  move(through.time_s);
  const std::size_t line = through.down ? layer_ : layer_ - 1;
  at_.depth_m = profile_[line].depth_m;  // exactly
  speed_mps_ = profile_[line].sound_speed_mps;
  tangent_ = through.tangent;
  begin_on_line(line);
}

void SoundRay::advance(double time_s) {
  // A ray that creeps along a line between two layers crosses it ever so often: then it lies level.
  constexpr int kMostCrossings = 100'000;
  for (int crossings = 0; time_s > 0.0; ++crossings) {
    level_ = level_ || crossings == kMostCrossings;
    const LayerEnd next = layer_end();
    if (!(next.time_s < time_s)) return move(time_s);
    cross(next);
    time_s -= next.time_s;
  }
}

RayPlace SoundRay::place() const {
  RayPlace out = at_;
  out.elevation_rad = -std::atan(tangent_);
  out.sound_speed_mps = speed_mps_;
  return out;
}

}  // namespace sonar
