// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "base/diagnostics.h"
#include "io/raw_index.h"
#include "model/navigation.h"
#include "model/sounder.h"

namespace sonar {

enum class HeaveSign { off, down, up };
enum class LeverArmSource { none, con0, settings };
enum class BeamAzimuthSense { clockwise, anticlockwise };

/// How the ship's sentences become the transducer's place.
struct NavigationParams {
  double time_offset_s = 0.0;
  double transducer_depth_m = 7.0;
  HeaveSign heave = HeaveSign::off;
  LeverArmSource lever_arm = LeverArmSource::con0;
  double lever_arm_x_m = 0.0;
  double lever_arm_y_m = 0.0;
  double lever_arm_z_m = 0.0;
  double mounting_azimuth_deg = 270.0;
  BeamAzimuthSense beam_azimuth_sense = BeamAzimuthSense::clockwise;
  bool beams_stabilised = true;
  double fix_limit_s = 30.0;
  double log_limit_s = 900.0;
  double max_speed_mps = 25.0;
  bool heading_from_course = true;
  std::string position_talker;
  std::string heading_talker;
  std::string speed_talker;
  std::string log_talker;
  std::string clock_talker;
  friend bool operator==(const NavigationParams&, const NavigationParams&) = default;
};

inline constexpr std::array<std::string_view, 3> kHeaveSignNames{"off", "down", "up"};
inline constexpr std::array<std::string_view, 3> kLeverArmSourceNames{"none", "con0", "settings"};

inline constexpr std::array<std::string_view, 2> kBeamAzimuthSenseNames{"clockwise", "anticlockwise"};

template <class Visitor>
void describe(Visitor& v, NavigationParams& p) {
  v.field("time_offset_s", p.time_offset_s,
          {.unit = "s",
           .min = -1e6,
           .max = 1e6,
           .text = "Added to the times of the pings before position, heading and speed are looked up for them; set it "
                   "when the sonar's clock was wrong.",
           .tier = Tier::basic});
  v.field(
      "transducer_depth_m", p.transducer_depth_m,
      {.unit = "m",
       .min = 0,
       .max = 100,
       .text =
           "Depth of the transducer below the mean water line, used where the raw file says 0; set it for each ship.",
       .tier = Tier::basic});
  v.choice("heave", p.heave, kHeaveSignNames,
           {"Whether recorded heave moves the transducer: choose off for a sonar that compensates heave itself, else "
            "down or up, the direction in which the recorded heave is positive.",
            Tier::basic});
  v.choice(
      "lever_arm", p.lever_arm, kLeverArmSourceNames,
      "Where the distance from the antenna to the transducer comes from: none leaves it out, con0 reads the raw file, "
      "settings takes lever_arm_x_m, _y_m and _z_m; choose settings where the file's values are missing or wrong.");
  v.field("lever_arm_x_m", p.lever_arm_x_m,
          {.unit = "m",
           .min = -500,
           .max = 500,
           .text = "Distance of the transducer from the antenna towards the bow, negative aft; set it where lever_arm "
                   "is settings."});
  v.field("lever_arm_y_m", p.lever_arm_y_m,
          {.unit = "m",
           .min = -500,
           .max = 500,
           .text = "Distance of the transducer from the antenna to starboard, negative to port; set it where lever_arm "
                   "is settings."});
  v.field("lever_arm_z_m", p.lever_arm_z_m,
          {.unit = "m",
           .min = -500,
           .max = 500,
           .text = "Distance of the transducer downwards from the antenna; set it where lever_arm is settings."});
  v.field("mounting_azimuth_deg", p.mounting_azimuth_deg,
          {.unit = "deg",
           .min = 0,
           .max = 360,
           .text = "Where the sonar looks, clockwise from the bow: 270 is port, 90 starboard. Set it for a sonar "
                   "mounted otherwise than the MS70.",
           .tier = Tier::basic});
  v.choice("beam_azimuth_sense", p.beam_azimuth_sense, kBeamAzimuthSenseNames,
           "Direction, seen from above, in which the raw file's beam azimuths increase; choose anticlockwise for a "
           "sonar that looks to starboard and whose azimuths are positive towards the bow.");
  v.field("beams_stabilised", p.beams_stabilised,
          {.text = "The sonar takes roll and pitch out of its beams, as the MS70 and ME70 do; switch it off for a "
                   "sonar that does not, so that its beams are turned by the recorded roll and pitch."});
  v.field("fix_limit_s", p.fix_limit_s,
          {.unit = "s",
           .min = 0,
           .max = 3600,
           .text = "A ping farther in time than this from any NMEA sentence has no position, heading or speed; raise "
                   "it for instruments that report rarely."});
  v.field("log_limit_s", p.log_limit_s,
          {.unit = "s",
           .min = 0,
           .max = 86400,
           .text = "A ping farther in time than this from any NMEA sentence of the vessel's log has no log; raise it "
                   "for logs that report rarely."});
  v.field("max_speed_mps", p.max_speed_mps,
          {.unit = "m s-1",
           .min = 1,
           .max = 1000,
           .text = "Highest speed of the ship that is believed: positions that jump away and back faster are left out. "
                   "Raise it for a fast craft, lower it where wrong positions remain."});
  v.field("heading_from_course", p.heading_from_course,
          {.text = "Use course over ground as heading above 1 m s-1 where no heading was recorded; switch it off where "
                   "currents are strong."});
  v.field("position_talker", p.position_talker,
          {.text = "NMEA talker whose positions are used, for example GP; empty takes the most frequent. Set it when "
                   "several receivers were recorded and another one is better."});
  v.field("heading_talker", p.heading_talker,
          {.text = "NMEA talker whose headings are used; empty takes the most frequent. Set it when several compasses "
                   "were recorded and another one is better."});
  v.field("speed_talker", p.speed_talker,
          {.text = "NMEA talker whose speed and course are used; empty takes the most frequent. Set it when several "
                   "instruments were recorded and another one is better."});
  v.field("log_talker", p.log_talker,
          {.text = "NMEA talker whose log is used; empty takes the most frequent. Set it when several logs were "
                   "recorded and another one is better."});
  v.field("clock_talker", p.clock_talker,
          {.text = "NMEA talker whose GPS time is compared with the sonar's clock; empty takes the most frequent. Set "
                   "it when several receivers were recorded and another one is better."});
}

/// {"position": "GP", "heading": "IN", "speed": "GP", "log": "SD", "clock": "GP"}; what nobody said is absent. Heading
/// may be "RAW0" (the sample data's own) or "course" (course over ground), speed may be "positions" (worked out of them).
using Talkers = std::map<std::string, std::string>;

/// A ping to be placed: its datagram time and what its first channel says of the ship.
struct PingMotion {
  TimeNs time = 0;
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double heave_m = 0.0;
  double heading_deg = 0.0;  ///< 0 = absent
  double transducer_depth_m = 0.0;
};
[[nodiscard]] PingMotion ping_attitude(const PingEntry& entry);

struct Navigation {
  std::vector<PingNavigation> pings;  ///< as given
  Talkers talkers;
  double gps_minus_clock_s = 0.0;         ///< median over all sentences of the chosen talker; NaN = none
  std::optional<std::size_t> first_jump;  ///< which series holds the first fix that was left out as a jump
  Diagnostics diagnostics;  ///< no_position, no_heading, bad_lever_arm, no_talker, position_jump, heading_from_course;
                            ///< ping_index of the first
};

/// Places every ping. One talker is chosen per quantity, the most frequent valid one over all the series given, and in
/// it one kind of sentence (GGA before RMC before GLL, HDT before THS before HDG, where equally frequent); they are
/// never mixed.
/// Position is interpolated along the geodesic between two fixes, log and speed linearly, heading and course over the
/// shorter arc; beyond the first and last sentence, and in gaps, values hold up to fix_limit_s (positions go on at
/// the speed of the last two fixes). Fixes that jump away and back (drop_jumps) are left out.
/// Heading falls back to the pings' own; where no ping has one, to the course over ground of pings that make more than
/// 1 m/s, and to the shorter arc between such pings where they lie round a slower one.
/// `time` of a result is the ping's plus time_offset_s; at that time the ship is where the sentences say, by the clock that
/// they were recorded with. gps_minus_clock_s, which tells that clock from GPS, is without it.
/// series   of all files concerned, in the order of the files
/// threads  pure
[[nodiscard]] Navigation navigate(std::span<const NavSeries* const> series, std::span<const PingMotion> pings,
                                  const SounderConfig& config, const NavigationParams& params);

/// The first and the last valid fix of the talker that navigate() would choose; empty where there is none.
[[nodiscard]] std::optional<std::pair<NavSample, NavSample>> first_and_last_fix(
    std::span<const NavSeries* const> series, const NavigationParams& params);

}  // namespace sonar
