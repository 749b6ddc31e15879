// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geo/frames.h"
#include "model/navigation.h"
#include "synth/array/pattern.h"
#include "synth/voyage.h"

namespace sonar::synth::array {

/// Where the array stands in one ping, and how sound comes to it.
struct View {
  PingNavigation navigation;
  Geographic origin;        ///< of the scene
  Point<Enu> transducer_m;  ///< in the scene's frame
  double heading_rad = 0.0;
  double seconds = 0.0;
  double roll_rad = 0.0;  ///< left over by the stabilisation: positive port up
  double pitch_rad = 0.0;
  double gradient_per_s = 0.0;  ///< of sound speed, positive where it rises with depth

  /// From the transducer, in the local frame there: north is not the same direction as at the scene's origin.
  [[nodiscard]] Point<Enu> from_transducer(const Point<Enu>& in_scene) const;
  /// The other way, to the accuracy of a scene's extent.
  [[nodiscard]] Point<Enu> in_scene(const Point<Enu>& from_transducer) const;
  /// Turns by heading only: bow, port, up.
  [[nodiscard]] Point<Vessel> along_ship(const Point<Enu>& from_transducer) const;
  [[nodiscard]] Point<Enu> from_ship(double bow, double port, double up) const;
  /// The direction from which the array hears a place: bent rays, residual roll and pitch.
  [[nodiscard]] Direction heard(const Point<Enu>& from_transducer) const;
};

/// unsteady      strength of the stabilisation's residue; 1 = amplitudes of 1 degree
/// gradient      of sound speed, 1/s
[[nodiscard]] View view_of(const Voyage& voyage, int ping, double unsteady, double gradient_per_s);

}  // namespace sonar::synth::array
