// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/array.h"
#include "base/sample_flags.h"
#include "signal/flag_params.h"

namespace sonar {

/// What the flags need to know of a ping's beams.
struct PingGeometry {
  double first_range_m = 0.0;  ///< of sample 0, may be negative
  double spacing_m = 0.0;
  double transducer_depth_m = 0.0;         ///< below the water line, positive down
  std::vector<double> elevation_deg;       ///< [fan], positive up
  std::vector<double> vertical_width_deg;  ///< [fan][beam], one-way -3 dB; empty = 0
  /// [fan][beam], positive up, of beams that roll and pitch with the hull; empty = each fan's elevation
  std::vector<double> level_elevation_deg;

  [[nodiscard]] double elevation_deg_of(int fan, int row) const {
    return level_elevation_deg.empty() ? elevation_deg[static_cast<std::size_t>(fan)]
                                       : level_elevation_deg[static_cast<std::size_t>(row)];
  }
};

/// Power of the pings before and after, of one shape with the ping; an empty view where there is none.
struct NeighbourPings {
  View3<const std::int16_t> before;
  View3<const std::int16_t> after;
};

/// All flags below by their switches, in the order near field, surface, dropouts, corrupted packets, interference, impulse noise.
/// in      power [fan][beam][sample], counts (10 log10(2)/256 dB re 1 W), kNoData = not recorded
/// out     flags, same shape: bits are added, none is cleared. kNoData gets `dropout`
/// errors  none; a geometry without elevations (or with NaN) leaves the surface unflagged
/// threads pure
/// cost    about 1.5 ms for 20 x 25 x 1320 samples
void flag_ping(View3<const std::int16_t> power, const PingGeometry& geometry, const FlagParams& params,
               const NeighbourPings& neighbours, View3<SampleFlags> flags);

/// Samples nearer than range_m: transducer ringing and self noise.
void flag_near_field(const PingGeometry& geometry, const NearFieldParams& params, View3<SampleFlags> flags);

/// Mode `fan`: the fans nearest the surface. Mode `edge`: each beam from the range on where its upper -3 dB edge comes
/// within margin_m of the surface, so that upper fans stay useful near the ship.
void flag_surface(const PingGeometry& geometry, const SurfaceParams& params, View3<SampleFlags> flags);

/// Samples that were not recorded: kNoData, long runs of one value, stretches that repeat the beam before bit by bit.
void flag_dropouts(View3<const std::int16_t> power, const DropoutParams& params, View3<SampleFlags> flags);

/// Stretches of single beams at a high level with sharp ends (corrupted packets). A stretch must stand above the median of
/// its up to 8 neighbours and above both neighbours in fan (in beam where there is one fan): overlapping beams show
/// every true target there. Levels count relative to each beam's own background, so that a noisy beam is no corrupted packets.
void flag_corrupted_packets(View3<const std::int16_t> power, const CorruptedPacketParams& params,
                            View3<SampleFlags> flags);

/// Thin high-level shells at constant range, in all fans or in one (each fan has its own frequency). A low quantile
/// over the beams must rise above its running median along range, and the rise must come at one range in all beams: a
/// school's or the seabed's does not.
void flag_interference(View3<const std::int16_t> power, const InterferenceParams& params, View3<SampleFlags> flags);

/// Peaks of up to 3 samples in one beam, far above the samples before and after, the neighbouring beams, and the same
/// place in the pings before and after where these are given and show more there than interference.
/// source  two-sided comparison as in Ryan et al., ICES J. Mar. Sci. 72 (2015) 2482
void flag_impulses(View3<const std::int16_t> power, const NeighbourPings& neighbours, const ImpulseParams& params,
                   View3<SampleFlags> flags);

}  // namespace sonar
