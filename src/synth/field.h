// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "synth/body.h"
#include "synth/layout.h"
#include "synth/scene.h"
#include "synth/truth.h"

namespace sonar::synth {

/// A scatterer as one ping sees it.
struct SeenScatterer {
  double elevation_rad;
  double azimuth_rad;  ///< clockwise from the bow, unwrapped about the sector's middle
  double sample;       ///< fractional
  double weight;       ///< sv V / (r^2 dr): spread over beam and pulse this becomes sv
};

/// The scatterers of a body whose centre and scatterers' offsets are given from the transducer, in the local frame.
void append_seen(std::vector<SeenScatterer>& seen, const Layout& layout, const Scatterers& body,
                 const Point<Enu>& centre_from_transducer, double heading_rad);

/// True where no scatterer of a body can reach any beam.
[[nodiscard]] bool out_of_reach(const Layout& layout, const Scatterers& body, const Point<Enu>& centre_from_transducer,
                                double heading_rad);

/// Expected sv of scatterers on the grid: each spread by every beam's two-way pattern and by the pulse.
/// side_lobe_db  energy of a pattern four times as wide, added; below -200 none
/// out           the smallest box that holds them; an empty array where nothing is reached
[[nodiscard]] SchoolField school_field(const Layout& layout, const std::vector<SeenScatterer>& seen, int school_id,
                                       double side_lobe_db);

}  // namespace sonar::synth
