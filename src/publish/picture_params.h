// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/describe.h"
#include "publish/movie_params.h"
#include "publish/volume_params.h"
#include "view/charts/chart_columns.h"
#include "view/sv_scale.h"

namespace sonar {

// What a user sets of a picture. Each option stands here once: flags of the command line, controls of the window, questions
// before a picture goes into a file, and the file of preferences are made from these descriptions.

enum class NoiseLook : std::uint8_t { shown, hatched, transparent };
inline constexpr std::array<std::string_view, 3> kNoiseLookNames{"shown", "hatched", "transparent"};

/// Which samples noise removal takes out of the pictures; growing keeps to the recipe.
struct TakenOut {
  bool near_field = true;
  bool surface = true;
  bool corrupted_packets = true;
  bool interference = true;
  bool impulse_noise = true;
  bool seabed = true;
};

template <class Visitor>
void describe(Visitor& v, TakenOut& p) {
  constexpr std::string_view kOfSamples = "slice- volume echogram";
  v.field(
      "near_field", p.near_field,
      {.text = "take ringing near the transducer out of the pictures", .flag = "keep-near-field", .suits = kOfSamples});
  v.field("surface", p.surface,
          {.text = "take the sea surface out of the pictures", .flag = "keep-surface", .suits = kOfSamples});
  v.field("corrupted_packets", p.corrupted_packets,
          {.text = "take stretches of corrupted packets out of the pictures",
           .flag = "keep-corrupted-packets",
           .suits = kOfSamples});
  v.field("interference", p.interference,
          {.text = "take interference at constant range out of the pictures",
           .flag = "keep-interference",
           .suits = kOfSamples});
  v.field("impulse_noise", p.impulse_noise,
          {.text = "take impulse noise out of the pictures", .flag = "keep-impulse-noise", .suits = kOfSamples});
  v.field(
      "seabed", p.seabed,
      {.text = "take the seabed and what lies behind out of the pictures", .flag = "keep-seabed", .suits = kOfSamples});
}

/// How data and schools look in every picture.
struct DisplayParams {
  SvScale scale;
  bool filtered = false;
  TakenOut take_out;
  NoiseLook removed = NoiseLook::hatched;
  NoiseLook weak = NoiseLook::transparent;
  double weak_below_db = 3.0;
  bool masks = true;
  bool tint = false;
  double core_at = 0.64;
  double fuzzy_above = 0.0;
  bool rejected = true;
  bool refused_echoes = true;
  bool grid_lines = false;
  bool north_up = false;
};

template <class Visitor>
void describe(Visitor& v, DisplayParams& p) {
  constexpr std::string_view kOfSamples = "slice- volume";
  constexpr std::string_view kShown = "slice- volume echogram";
  v.group("scale", p.scale, "how Sv becomes colour");
  v.field("filtered", p.filtered,
          {.text = "slices show Sv after the median filter, on which schools are grown; off = as recorded",
           .flag = kNoFlag});
  v.group("take_out", p.take_out, "what noise removal takes out");
  v.choice("removed", p.removed, kNoiseLookNames,
           {"how samples that noise removal took out look; volumes and echograms leave them out unless they are shown",
            Tier::expert, kShown});
  v.choice("weak", p.weak, kNoiseLookNames,
           {"how samples that hardly rise above the noise look; volumes leave them out unless they are shown",
            Tier::expert, kOfSamples});
  v.field("weak_below_db", p.weak_below_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "a sample with less signal-to-noise is weak",
           .flag = "weak-db",
           .suits = kOfSamples});
  v.field("masks", p.masks, {.text = "show schools over the data"});
  v.field(
      "tint", p.tint,
      {.text = "tint schools over the data, beside their outlines: the data's colours are no longer those of the bar",
       .suits = kOfSamples});
  v.field("core_at", p.core_at,
          {.unit = "1",
           .min = 0.01,
           .max = 1,
           .text = "confidence from which a voxel is core",
           .flag = "core",
           .suits = "slice- volume propagation observation-map"});
  v.field("fuzzy_above", p.fuzzy_above,
          {.unit = "1",
           .min = 0,
           .max = 0.99,
           .text = "confidence above which a voxel belongs to the fuzzy area",
           .flag = "fuzzy",
           .suits = "volume"});
  v.field("rejected", p.rejected, {.text = "show rejected schools, in grey"});
  v.field("refused_echoes", p.refused_echoes,
          {.text = "mark the echoes above the background that were judged no schools",
           .flag = "refused",
           .suits = "slice- volume observation-map timeline echogram"});
  v.field("grid_lines", p.grid_lines, {.text = "lines of the axes across slices", .flag = "grid", .suits = "slice-"});
  v.field("north_up", p.north_up,
          {.text = "north points up in slices from above; off = the bow does", .suits = "slice-top slice-plane"});
}

// What is asked for one kind of picture alone. Their groups in PictureParams are named as the kinds are.

struct RangeSliceParams {
  double range_m = 0.0;
};

template <class Visitor>
void describe(Visitor& v, RangeSliceParams& p) {
  v.field(
      "range_m", p.range_m,
      {.unit = "m", .min = 0, .max = 1e6, .text = "slant range; 0 = through the largest school, else half way out"});
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
  v.choice("plane", p.plane, kPlaneLiesNames,
           "how the plane lies; through school = horizontal through the largest, else half way out");
  v.field("depth_m", p.depth_m,
          {.unit = "m", .min = -1e6, .max = 1e6, .text = "horizontal plane: depth below the sea surface"});
  v.field("bearing_deg", p.bearing_deg,
          {.unit = "deg", .min = -1e6, .max = 1e6, .text = "vertical plane through the sonar along this true bearing"});
  v.field("through", p.through, {.text = "vertical plane through two places X,Y,X,Y, m towards bow and starboard"});
  v.field("point", p.point,
          {.text = "oblique plane through X,Y,Z, m from the transducer towards bow, starboard and down"});
  v.field("normal", p.normal, {.text = "oblique plane: its normal X,Y,Z, towards the viewer"});
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
  bool maximum = false;
};

template <class Visitor>
void describe(Visitor& v, TimelineParams& p) {
  v.field("whole_survey", p.whole_survey, {.text = "all observations, not one alone"});
  v.field("along_log", p.along_log, {.text = "against the vessel's log instead of time", .suits = "timeline echogram"});
  v.field("maximum", p.maximum, {.text = "the maximum over beams instead of the mean"});
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

struct PictureParams {
  RangeSliceParams slice_range;
  PlaneSliceParams slice_plane;
  CameraParams volume;
  PropagationParams propagation;
  TimelineParams timeline;
  EchogramParams echogram;
  ChartParams chart;
  MovieParams movie;
};

template <class Visitor>
void describe(Visitor& v, PictureParams& p) {
  v.group("slice-range", p.slice_range, "the shell at one range");
  v.group("slice-plane", p.slice_plane, "a plane in metres");
  v.group("volume", p.volume, "where a volume is looked at from");
  v.group("propagation", p.propagation, "a ping and its neighbours");
  v.group("timeline", p.timeline, "an echogram over time");
  v.group("echogram", p.echogram, "one beam, fan or channel over time");
  v.group("chart", p.chart, "figures of schools");
  v.group("movie", p.movie, "what moves in a movie, and how fast");
}

/// How large a picture in a file is.
struct PaperParams {
  int width_px = 1200;
  int height_px = 900;
  double scale = 1.0;
};

template <class Visitor>
void describe(Visitor& v, PaperParams& p) {
  v.field("width_px", p.width_px, {.unit = "px", .min = 320, .max = 16384, .text = "width of the picture"});
  v.field("height_px", p.height_px, {.unit = "px", .min = 240, .max = 16384, .text = "height of the picture"});
  v.field("scale", p.scale,
          {.unit = "1",
           .min = 0.25,
           .max = 8,
           .text = "pixels of the file per pixel of the size: 2 for print or high-density screens"});
}

}  // namespace sonar
