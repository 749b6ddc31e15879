// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "geo/frames.h"
#include "synth/random.h"

namespace sonar::synth::array {

/// Along a school's length, across, up; metres from its centre.
struct Own;

/// Kinds of school that people have drawn from sonar, none an ellipsoid.
/// source  Gerlotto and Paramo 2003 (amoebae with nuclei and vacuoles), Misund 1993 and Freon et al. 1992 (vacuoles,
///         splitting), Pitcher et al. 1996 (rings, hourglass, pseudopodia), Nottestad and Axelsen 1999 (funnels and
///         columns of herring under attack), Rieucau et al. 2015 (bent ribbons)
enum class FormKind { vacuolated, ring, crescent, sheets, hourglass, tadpole, amoeba, column };
inline constexpr std::array<std::string_view, 8> kFormNames = {"vacuolated", "ring",    "crescent", "sheets",
                                                               "hourglass",  "tadpole", "amoeba",   "column"};

/// A random field with zero mean and unit variance: a sum of waves.
class WaveField {
 public:
  /// length_m  of the longest waves; the shortest are a third of it
  WaveField(double length_m, RandomStream& random);
  [[nodiscard]] double at(const Point<Own>& p) const;

 private:
  struct Wave {
    Point<Own> number;
    double phase = 0.0;
  };
  std::vector<Wave> waves_;
};

/// A school's body at rest, and how it changes as it swims.
class Form {
 public:
  /// size_m  full extents of the box that holds it at rest
  Form(FormKind kind, const Point<Own>& size_m, RandomStream random);

  [[nodiscard]] FormKind kind() const { return kind_; }
  /// Fish a cubic metre over the school's own unit at a place of the body at rest; 0 outside; never above kMostDensity.
  [[nodiscard]] double density(const Point<Own>& at_rest) const;
  static constexpr double kMostDensity = 6.0;
  /// Where a fish of the body at rest is at a time since the first ping.
  [[nodiscard]] Point<Own> place(const Point<Own>& at_rest, double seconds) const;
  /// Volume then over the volume at rest.
  [[nodiscard]] double swelling(double seconds) const;
  [[nodiscard]] const Point<Own>& half_m() const { return half_m_; }

 private:
  [[nodiscard]] double shape(const Point<Own>& unit) const;

  FormKind kind_;
  Point<Own> half_m_;
  double rate_ = 0.0;  ///< rad/s of its slow changes
  double phase_ = 0.0;
  double bend_ = 0.0;
  double split_s_ = 0.0;
  std::vector<Point<Own>> holes_;
  std::vector<double> hole_radius_;
  std::vector<WaveField> fields_;  ///< one, of densities
};

}  // namespace sonar::synth::array
