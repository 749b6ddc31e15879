// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"

namespace sonar {

// What users may set of each judge; its other numbers are constants beside it. A recipe tells those of pings under `detect`
// and those of tracks under `track`.

inline constexpr std::array<std::string_view, 6> kJudgeNames = {"size", "prominence", "confirmation",
                                                                "ship", "level",      "surface"};

/// Whether a list of judges, commas between, holds one.
[[nodiscard]] bool names_judge(std::string_view list, std::string_view judge);
/// The first entry of such a list that is no judge's name; empty = none.
[[nodiscard]] std::string_view no_judge_in(std::string_view list);

struct SizeParams {
  double min_range_m = 5.0;
  int min_beams = 2;
  int min_fans = 2;
};

template <class Visitor>
void describe(Visitor& v, SizeParams& p) {
  v.field("min_range_m", p.min_range_m,
          {.unit = "m",
           .min = 0,
           .max = 500,
           .text = "A school extends at least this far along range; lower it to find smaller schools."});
  v.field("min_beams", p.min_beams,
          {.unit = "beams",
           .min = 1,
           .max = 1000,
           .text = "A school spans at least this many beams; lower it to find smaller schools, at the price of more "
                   "false ones."});
  v.field("min_fans", p.min_fans,
          {.unit = "fans",
           .min = 1,
           .max = 1000,
           .text = "A school spans at least this many fans; lower it to find flatter schools, at the price of more "
                   "false ones."});
}

struct ConfirmationParams {
  double evidence =
      0.0;  ///< of a school over its sightings; not a parameter: it follows from DetectParams::false_alarm
  int pings = 3;
  int window = 5;
};

template <class Visitor>
void describe(Visitor& v, ConfirmationParams& p) {
  v.field("confirm_pings", p.pings,
          {.unit = "pings",
           .min = 1,
           .max = 100,
           .text = "A school is seen in at least this many pings of confirm_window neighbouring ones; lower it for a "
                   "fast ship that passes schools in few pings, raise it for fewer false schools."});
  v.field("confirm_window", p.window,
          {.unit = "pings",
           .min = 1,
           .max = 100,
           .text = "Number of neighbouring pings among which a school must be seen confirm_pings times; raise it where "
                   "schools fade from ping to ping, lower it where false schools flicker."});
}

struct ShipParams {
  double drift_share = 0.3;
};

template <class Visitor>
void describe(Visitor& v, ShipParams& p) {
  v.field("ship_drift_share", p.drift_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "An echo that moves relative to the ship by less than this share of the ship's own way follows the "
                   "ship and is no school; lower it where schools may follow the ship, 0 switches the test off."});
}

struct LevelParams {
  double min_level_db = -77.0;  ///< a fish of 10 cm (TS -50 dB) in 500 m3, what a beam tells apart at 250 m
};

template <class Visitor>
void describe(Visitor& v, LevelParams& p) {
  v.field("min_level_db", p.min_level_db,
          {.unit = "dB",
           .min = -200,
           .max = 0,
           .text = "Lowest mean Sv of all members together for an echo to be a school; lower it for krill and other "
                   "weak scatterers, raise it to leave weak scatterers out.",
           .tier = Tier::basic});
}

}  // namespace sonar
