// SPDX-License-Identifier: Apache-2.0
#include "synth/array/form.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sonar::synth::array {
namespace {

constexpr int kWaves = 14;

double square(double x) { return x * x; }

/// 1 inside, 0 outside, with a soft edge of 0.1.
double inside(double q) { return std::clamp((1.0 - q) / 0.1, 0.0, 1.0); }

}  // namespace

WaveField::WaveField(double length_m, RandomStream& random) {
  for (int i = 0; i < kWaves; ++i) {
    const double up = random.uniform(-1.0, 1.0);
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double k = 2.0 * std::numbers::pi / (length_m * random.uniform(1.0 / 3.0, 1.0));
    const double level = std::sqrt(1.0 - up * up);
    waves_.push_back({{k * level * std::cos(turn), k * level * std::sin(turn), k * up},
                      random.uniform(0.0, 2.0 * std::numbers::pi)});
  }
}

double WaveField::at(const Point<Own>& p) const {
  double sum = 0.0;
  for (const Wave& w : waves_) sum += std::cos(w.number.x * p.x + w.number.y * p.y + w.number.z * p.z + w.phase);
  return sum * std::sqrt(2.0 / kWaves);
}

Form::Form(FormKind kind, const Point<Own>& size_m, RandomStream random) : kind_(kind), half_m_(size_m * 0.5) {
  rate_ = 2.0 * std::numbers::pi / random.uniform(90.0, 240.0);
  phase_ = random.uniform(0.0, 2.0 * std::numbers::pi);
  bend_ = random.uniform(1.2, 2.4);
  split_s_ = random.uniform(60.0, 200.0);
  const int holes = kind == FormKind::vacuolated ? 5 + random.index(4) : 0;
  for (int i = 0; i < holes; ++i) {
    holes_.push_back({random.uniform(-0.65, 0.65), random.uniform(-0.65, 0.65), random.uniform(-0.5, 0.5)});
    hole_radius_.push_back(random.uniform(0.3, 0.5));
  }
  const double longest = std::max({size_m.x, size_m.y, size_m.z});
  fields_.emplace_back(kind == FormKind::amoeba ? 0.45 * longest : 0.3 * longest, random);
}

double Form::shape(const Point<Own>& u) const {
  const double ball = u.x * u.x + u.y * u.y + u.z * u.z;
  switch (kind_) {
    case FormKind::vacuolated: {
      double whole = inside(ball);
      for (std::size_t i = 0; i < holes_.size(); ++i) {
        const Point<Own> d = u - holes_[i];
        if (square(d.x) + square(d.y) + square(d.z) < square(hole_radius_[i])) whole = 0.0;
      }
      return whole;
    }
    case FormKind::ring:
      return inside(square((std::hypot(u.x, u.y) - 0.7) / 0.3) + square(u.z));
    case FormKind::crescent:  // bent by place(); thicker in the middle
      return inside(square(u.x) * square(u.x) + square(u.y / (0.25 + 0.15 * (1.0 - u.x * u.x))) + square(u.z));
    case FormKind::sheets: {
      const double level = std::abs(u.z) < 0.33 ? 0.0 : std::copysign(0.7, u.z);
      return inside(square(u.x) + square(u.y)) * inside(square((u.z - level) / 0.16));
    }
    case FormKind::hourglass:
      return std::abs(u.x) > 1.0 ? 0.0
                                 : inside((square(u.y) + square(u.z)) /
                                          square(0.22 + 0.75 * std::sqrt(std::abs(std::sin(std::numbers::pi * u.x)))));
    case FormKind::tadpole: {
      const double head = square((u.x - 0.55) / 0.45) + square(u.y) + square(u.z);
      const double tail = u.x > 0.4 ? 2.0 : square(u.y / 0.22) + square(u.z / 0.3);
      return inside(head) * (1.0 + 4.5 * std::exp(-3.5 * head)) + 0.7 * inside(tail) * inside(square(u.x));
    }
    case FormKind::amoeba:
      return inside(ball);
    case FormKind::column:
      return std::abs(u.z) > 1.0
                 ? 0.0
                 : inside((square(u.x) + square(u.y)) / square(0.35 + 0.65 * square((u.z + 1.0) / 2.0)));
  }
  return 0.0;
}

double Form::density(const Point<Own>& p) const {
  const Point<Own> unit{p.x / half_m_.x, p.y / half_m_.y, p.z / half_m_.z};
  const double whole = shape(unit);
  if (whole <= 0.0) return 0.0;
  const double field = fields_.front().at(p);
  // The amoeba is where its field is high, so that its edge and its nuclei are the field's own.
  const double uneven =
      kind_ == FormKind::amoeba ? (field > -0.3 ? std::exp(0.8 * field - 0.2) : 0.0) : std::exp(0.35 * field);
  return std::min(kMostDensity, whole * uneven);
}

Point<Own> Form::place(const Point<Own>& p, double seconds) const {
  const double slow = std::sin(rate_ * seconds + phase_);
  switch (kind_) {
    case FormKind::vacuolated: {
      const double grown = std::sqrt(swelling(seconds));
      return {p.x * grown, p.y * grown, p.z};
    }
    case FormKind::ring: {  // mills and breathes
      const double turn = 0.02 * seconds;
      const double grown = std::sqrt(swelling(seconds));
      return {grown * (p.x * std::cos(turn) - p.y * std::sin(turn)),
              grown * (p.x * std::sin(turn) + p.y * std::cos(turn)), p.z};
    }
    case FormKind::crescent: {  // an arc that bends more and less
      const double radius = 2.0 * half_m_.x / (bend_ * (1.0 + 0.4 * slow));
      const double angle = p.x / radius;
      return {(radius - p.y) * std::sin(angle), radius - (radius - p.y) * std::cos(angle) - 0.25 * half_m_.x, p.z};
    }
    case FormKind::sheets:
      return {p.x, p.y, p.z + 0.4 * half_m_.z * std::sin(2.5 * p.x / half_m_.x + rate_ * seconds + phase_)};
    case FormKind::hourglass: {  // the lobes part, the neck is drawn out
      const double apart = std::max(0.0, seconds - split_s_) * 0.12;
      return {p.x + std::clamp(6.0 * p.x / half_m_.x, -1.0, 1.0) * std::min(apart, 0.8 * half_m_.x), p.y, p.z};
    }
    case FormKind::tadpole: {
      const double back = std::max(0.0, (0.5 * half_m_.x - p.x) / half_m_.x);
      return {p.x, p.y + 0.35 * half_m_.y * back * std::sin(3.0 * back + 4.0 * rate_ * seconds + phase_), p.z};
    }
    case FormKind::amoeba:
      return {p.x + 0.25 * half_m_.x * std::sin(1.8 * p.y / half_m_.y + rate_ * seconds + phase_),
              p.y + 0.25 * half_m_.y * std::sin(1.8 * p.x / half_m_.x + 0.7 * rate_ * seconds), p.z};
    case FormKind::column: {
      const double height = (p.z / half_m_.z + 1.0) / 2.0;
      return {p.x + 0.5 * half_m_.x * height * slow, p.y, p.z};
    }
  }
  return p;
}

double Form::swelling(double seconds) const {
  if (kind_ != FormKind::vacuolated && kind_ != FormKind::ring) return 1.0;
  return 1.0 + 0.2 * std::sin(rate_ * seconds + phase_);
}

}  // namespace sonar::synth::array
