// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/describe.h"
#include "pipeline/stages/noise_step.h"
#include "view/charts/chart_columns.h"

namespace sonar {

// What is asked for one kind of picture alone. Their groups in PictureParams are named as the kinds are.

struct RangeSliceParams {
  double range_m = 0.0;
};

template <class Visitor>
void describe(Visitor& v, RangeSliceParams& p) {
  constexpr std::string_view kOfRange = "slice-range noise-steps";
  v.field("range_m", p.range_m,
          {.unit = "m",
           .min = 0,
           .max = 1e6,
           .text = "slant range; 0 = through the largest school, else half way out",
           .suits = kOfRange});
}

enum class PlaneLies : std::uint8_t { through_school, horizontal, along_bearing, through_places, oblique };
inline constexpr std::array<std::string_view, 5> kPlaneLiesNames{"through_school", "horizontal", "along_bearing",
                                                                 "through_places", "oblique"};

struct PlaneSliceParams {
  PlaneLies plane = PlaneLies::through_school;
  double depth_m = 50.0;
  double bearing_deg = 0.0;
  std::string through = "0,0,0,300";
  std::string point = "0,0,0";
  std::string normal = "1,0,0.5";
};

template <class Visitor>
void describe(Visitor& v, PlaneSliceParams& p) {
  constexpr std::string_view kOfPlane = "slice-plane noise-steps";
  v.choice("plane", p.plane, kPlaneLiesNames,
           {"how the plane lies; through school = horizontal through the largest, else half way out", Tier::expert,
            kOfPlane});
  v.field("depth_m", p.depth_m,
          {.unit = "m",
           .min = -1e6,
           .max = 1e6,
           .text = "horizontal plane: depth below the sea surface",
           .suits = kOfPlane});
  v.field("bearing_deg", p.bearing_deg,
          {.unit = "deg",
           .min = -1e6,
           .max = 1e6,
           .text = "vertical plane through the sonar along this true bearing",
           .suits = kOfPlane});
  v.field("through", p.through,
          {.text = "vertical plane through two places X,Y,X,Y, m towards bow and starboard", .suits = kOfPlane});
  v.field("point", p.point,
          {.text = "oblique plane through X,Y,Z, m from the transducer towards bow, starboard and down",
           .suits = kOfPlane});
  v.field("normal", p.normal, {.text = "oblique plane: its normal X,Y,Z, towards the viewer", .suits = kOfPlane});
}

struct CameraParams {
  std::string eye;
  std::string target;
  int eye_ping = -1;
  double orbit_deg = 0.0;
  double rise_deg = 0.0;
  double zoom = 1.0;
  double seconds = 0.0;
};

template <class Visitor>
void describe(Visitor& v, CameraParams& p) {
  v.field("eye", p.eye, {.text = "camera's place X,Y,Z, m towards bow, starboard and down; empty = an overview"});
  v.field("target", p.target, {.text = "place that the camera looks at, X,Y,Z; goes with the eye"});
  v.field(
      "eye_ping", p.eye_ping,
      {.unit = "1",
       .min = -1,
       .max = 1e9,
       .text = "earth-fixed: ping in which the camera stands so; -1 = the ping that is shown, and of a movie the one "
               "in its middle"});
  v.field("orbit_deg", p.orbit_deg,
          {.unit = "deg", .min = -360, .max = 360, .text = "turn the camera about its target"});
  v.field("rise_deg", p.rise_deg, {.unit = "deg", .min = -180, .max = 180, .text = "lift the camera about its target"});
  v.field("zoom", p.zoom, {.unit = "1", .min = 0.01, .max = 100, .text = "above 1: nearer"});
  v.field("seconds", p.seconds,
          {.unit = "s", .min = 0, .max = 1e6, .text = "no further frame is begun after this time; 0 = no limit"});
}

struct PropagationParams {
  int neighbours = 2;
  bool side_view = false;
};

template <class Visitor>
void describe(Visitor& v, PropagationParams& p) {
  v.field("neighbours", p.neighbours, {.unit = "pings", .min = 0, .max = 100, .text = "pings before and after"});
  v.field("side_view", p.side_view, {.text = "masks from the side instead of from above", .flag = "side"});
}

struct TimelineParams {
  bool whole_survey = false;
  bool along_log = false;
  bool maximum = true;  ///< as the window's timelines; off = the mean over beams
};

template <class Visitor>
void describe(Visitor& v, TimelineParams& p) {
  v.field("whole_survey", p.whole_survey, {.text = "all observations, not one alone"});
  v.field("along_log", p.along_log, {.text = "against the vessel's log instead of time", .suits = "timeline echogram"});
  v.field("maximum", p.maximum, {.text = "draw the maximum over beams"});
}

struct EchogramParams {
  bool of_fan = false;
  std::string channel;
  bool depth = false;
  bool along_log = false;
  int from_ping = 0;
  int to_ping = -1;
  std::string below;
};

template <class Visitor>
void describe(Visitor& v, EchogramParams& p) {
  v.field("of_fan", p.of_fan, {.text = "all beams of the fan as one, their linear mean weighted by volume"});
  v.field("channel", p.channel,
          {.text = "of a sounder without fans: the channel, by its number from 1 or its frequency in kHz; empty = the "
                   "first"});
  v.field("depth", p.depth, {.text = "against depth below the sea surface instead of range"});
  v.field("along_log", p.along_log, {.text = "against the vessel's log instead of time", .flag = kNoFlag});
  v.field("from_ping", p.from_ping, {.unit = "1", .min = 0, .max = 1e9, .text = "first ping that is shown"});
  v.field("to_ping", p.to_ping,
          {.unit = "1", .min = -1, .max = 1e9, .text = "last ping that is shown; -1 = the observation's last"});
  v.field("below", p.below,
          {.text = "a second echogram under the same time axis, of this other observation of the survey; auto = of an "
                   "EK60 that ran at the same time"});
}

struct ChartParams {
  ChartTable table = ChartTable::school_pings;
  std::string x = "time_utc";
  std::string y = "sv_mean_db";
  int bins = 0;
  friend bool operator==(const ChartParams&, const ChartParams&) = default;
};

template <class Visitor>
void describe(Visitor& v, ChartParams& p) {
  v.choice("table", p.table, kChartTableNames, "whose figures: of schools in each of their pings, or of whole schools");
  v.field(
      "x", p.x,
      {.text = "column of the table along the horizontal axis; time_utc of a whole school is that of its first ping"});
  v.field("y", p.y,
          {.text = "column of the table along the vertical axis; empty = a histogram of the horizontal one's"});
  v.field(
      "bins", p.bins,
      {.unit = "1",
       .min = 0,
       .max = 200,
       .text = "about how many bins a histogram has, whose edges are round numbers; 0 = as the spread of the values "
               "has it (Freedman and Diaconis)"});
}

struct FrequencyParams {
  bool one_ping = false;
  bool water = true;
  friend bool operator==(const FrequencyParams&, const FrequencyParams&) = default;
};

template <class Visitor>
void describe(Visitor& v, FrequencyParams& p) {
  v.field("one_ping", p.one_ping,
          {.text = "of one ping alone, not of all of a school's", .tier = Tier::basic, .suits = "frequency curves"});
  v.field("water", p.water, {.text = "show the water round each school too", .tier = Tier::basic});
}

/// What curves are of.
enum class SchoolCurve : std::uint8_t { distribution, tolerance, avoidance };
inline constexpr std::array<std::string_view, 3> kSchoolCurveNames{"distribution", "tolerance", "avoidance"};
enum class AgainstShip : std::uint8_t { range, bearing, time, all };
inline constexpr std::array<std::string_view, 4> kAgainstShipNames{"range", "bearing", "time", "all"};

struct CurvesParams {
  SchoolCurve curve = SchoolCurve::distribution;
  bool one_ping = false;
  AgainstShip over = AgainstShip::all;
  friend bool operator==(const CurvesParams&, const CurvesParams&) = default;
};

template <class Visitor>
void describe(Visitor& v, CurvesParams& p) {
  v.choice(
      "curve", p.curve, kSchoolCurveNames,
      {"how Sv is distributed in a school and in the water round it; how its size changes with the tolerance that it "
       "grows with; or how all schools behave against the ship",
       Tier::basic});
  v.field(
      "one_ping", p.one_ping,
      {.text = "the distribution of one ping alone, not of all of a school's", .tier = Tier::basic, .flag = kNoFlag});
  v.choice("over", p.over, kAgainstShipNames,
           {"against the ship: over range, bearing from the bow or time to the closest approach", Tier::basic});
}

/// The slice that noise steps are shown of.
enum class StepsSlice : std::uint8_t { live, top, side, range, plane };
inline constexpr std::array<std::string_view, 5> kStepsSliceNames{"live", "top", "side", "range", "plane"};

/// A step that is compared with another: none, or a NoiseStep.
using ComparedStep = std::uint8_t;
inline constexpr auto kComparedStepNames = [] {
  std::array<std::string_view, kNoiseStepNames.size() + 1> names{"none"};
  for (std::size_t i = 0; i < kNoiseStepNames.size(); ++i) names[i + 1] = kNoiseStepNames[i];
  return names;
}();

struct NoiseStepsParams {
  StepsSlice slice = StepsSlice::live;
  ComparedStep before = 0;
  ComparedStep after = 0;
  bool mark = true;
  double mark_db = 6.0;
  double difference_db = 20.0;
  friend bool operator==(const NoiseStepsParams&, const NoiseStepsParams&) = default;
};

template <class Visitor>
void describe(Visitor& v, NoiseStepsParams& p) {
  v.choice(
      "slice", p.slice, kStepsSliceNames,
      {"the slice whose noise steps are shown; live = the window's that was used last, in a file the one from above",
       Tier::basic});
  v.choice("before", p.before, kComparedStepNames,
           {"the step that another is compared with, at a larger size; none = the one before it", Tier::basic});
  v.choice("after", p.after, kComparedStepNames,
           {"the step that is compared with the one before; none = all steps side by side", Tier::basic});
  v.field("mark", p.mark, {.text = "mark the samples that a step took out, filled in or changed", .tier = Tier::basic});
  v.field("mark_db", p.mark_db,
          {.unit = "dB", .min = 0, .max = 100, .text = "a sample is marked as changed from this on"});
  v.field("difference_db", p.difference_db,
          {.unit = "dB", .min = 0.5, .max = 100, .text = "difference at the ends of its scale"});
}

}  // namespace sonar
