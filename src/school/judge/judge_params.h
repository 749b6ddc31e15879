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
          {.unit = "m", .min = 0, .max = 500, .text = "least extent of a school along range"});
  v.field("min_beams", p.min_beams,
          {.unit = "beams", .min = 1, .max = 1000, .text = "least number of beams of a school"});
  v.field("min_fans", p.min_fans, {.unit = "fans", .min = 1, .max = 1000, .text = "least number of fans of a school"});
}

struct ConfirmationParams {
  double evidence = 0.0;  ///< of a school over its sights; not a parameter: it follows from DetectParams::false_alarm
  int pings = 3;
  int window = 5;
};

template <class Visitor>
void describe(Visitor& v, ConfirmationParams& p) {
  v.field("confirm_pings", p.pings,
          {.unit = "pings", .min = 1, .max = 100, .text = "a school is seen at least so often ..."});
  v.field("confirm_window", p.window,
          {.unit = "pings", .min = 1, .max = 100, .text = "... in so many neighbouring pings"});
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
           .text = "no school: moves by less beside the ship than this share of the ship's way; 0 = not looked at"});
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
           .text = "no school: the Sv of its members together is lower; lower for krill"});
}

}  // namespace sonar
