// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/frames.h"
#include "geo/sector.h"
#include "model/current.h"
#include "view/theme.h"
#include "view/units.h"

namespace sonar {

struct ContextScene;

/// The water's velocity below the ship at one time.
struct CurrentColumn {
  std::vector<CurrentAt> at;  ///< by rising depth below the sea surface; depths of which nothing is told are left out
  double longest_mps = 0.0;   ///< of the longest arrows, in every ping: faster water is drawn cut at it
  friend bool operator==(const CurrentColumn&, const CurrentColumn&) = default;
};

/// Depths at which arrows stand: even ones of the unit of lengths, at most 15 down to the sector's deepest place, m below the
/// sea surface.
[[nodiscard]] std::vector<double> current_depths(const Sector& sector, double transducer_depth_m,
                                                 const Units& units = {});

/// How long a speed is drawn: the longest arrows no longer than a quarter of the range. The speed is a whole one, two or five of the
/// unit of speeds, and so are the metres of 1 m/s.
struct CurrentScale {
  double speed_mps = 0.0;
  double length_m = 0.0;  ///< of an arrow at that speed
};
/// Empty where nothing moves.
[[nodiscard]] std::optional<CurrentScale> current_scale(const Sector& sector, const CurrentColumn& column,
                                                        const Units& units = {});
/// For the legend: "current below the ship: 0.2 m/s is 50 m long", and what two heads mean where an arrow has them; empty
/// where no arrow is drawn.
[[nodiscard]] std::string current_words(const Sector& sector, const CurrentColumn& column,
                                        const std::optional<double>& heading_deg, const Units& units = {});

struct CurrentArrow {
  Point<Sonar> from;  ///< straight below the ship, at the depth
  Point<Sonar> to;    ///< where the water flows to, level with it
  double depth_m = 0.0;
  bool cut = false;  ///< the water is faster than the arrow is long: drawn with two heads
};
/// Turned into the ship's frame by its true heading; none where that is unknown, and none of water that has no direction.
[[nodiscard]] std::vector<CurrentArrow> current_arrows(const Sector& sector, const CurrentColumn& column,
                                                       const std::optional<double>& heading_deg,
                                                       double transducer_depth_m);

[[nodiscard]] Rgba8 current_colour();
/// The arrows, on a thin line from the sea surface down to the deepest.
void add_current_arrows(ContextScene& scene, const std::vector<CurrentArrow>& arrows, double transducer_depth_m,
                        const Theme& theme);

}  // namespace sonar
