// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geo/sector.h"
#include "model/mask.h"
#include "model/navigation.h"
#include "view/theme.h"
#include "view/volume/context_scene.h"
#include "view/volume/earth_pose.h"

namespace sonar {

/// A school through its pings, to be drawn on the earth.
struct TrailSchool {
  struct There {
    std::int64_t ping_index = 0;
    const PingMask* mask = nullptr;
  };
  std::shared_ptr<const void> owner;  ///< of the masks: the same one has the same masks
  Rgba8 colour{0, 0, 0, 255};
  bool selected = false;
  std::vector<There> pings;  ///< rising
};

/// What of the past is drawn round a ping.
struct TrailParams {
  bool ship_track = false;     ///< a line on the sea surface
  bool school_tracks = false;  ///< a line through each school's middles
  int pings = 0;               ///< outlines of schools in so many pings before; 0 = none
  [[nodiscard]] bool any() const { return ship_track || school_tracks || pings > 0; }
};

/// What tracks and trails are made of.
struct TrailSubject {
  std::shared_ptr<const std::vector<PingNavigation>> pings;  ///< of the observation; null = no trails
  bool beams_stabilised = true;                              ///< false: roll and pitch turn what a ping has seen
  std::vector<TrailSchool> schools;
};

/// Lines of the ship's way and of schools' ways and outlines, each placed by its own ping's position, heading and, where
/// beams are not stabilised, attitude. What a mask looks like is made once and kept as long as its school is.
/// threads  one at a time
class SchoolTrails {
 public:
  /// Pings without position or heading are left out; a line breaks there. Where the ship's own are not known, nothing is
  /// drawn.
  /// ping_index  that is looked at: trails end before it
  /// ship        there, in whose sonar frame the lines are
  /// out         farther than 8 ranges from the ship there is nothing
  [[nodiscard]] std::vector<SceneLine> lines(const Sector& sector, const TrailSubject& subject, std::int64_t ping_index,
                                             const PingNavigation& ship, const TrailParams& params, const Theme& theme);

  /// Masks whose outlines were made so far; for tests.
  [[nodiscard]] std::int64_t outlines_made() const { return outlines_made_; }

 private:
  /// A mask in its ping's sonar frame, stabilised or not.
  struct Look {
    std::optional<Point<Sonar>> middle;
    std::optional<std::vector<std::vector<Point<Sonar>>>> outlines;
  };
  using Looks = std::map<const PingMask*, Look>;
  class Drawing;

  std::map<std::shared_ptr<const void>, Looks> kept_;
  std::shared_ptr<const std::vector<PingNavigation>> poses_of_;
  std::vector<std::optional<EarthPose>> poses_;
  std::optional<Geographic> origin_;
  std::int64_t outlines_made_ = 0;
};

/// How much of its colour a trail keeps that is so many pings old: 1 for the newest, less for each older one, never nothing.
/// age  1..of
[[nodiscard]] double trail_strength(int age, int of);

}  // namespace sonar
