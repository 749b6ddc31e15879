// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"
#include "model/grow_params.h"
#include "pipeline/recipe/recipe.h"
#include "publish/picture_params.h"

namespace sonar {

/// How a click becomes a school, and a school a track.
struct SelectParams {
  GrowMode mode = GrowMode::tracked;
  Connectivity connectivity = Connectivity::faces;
  double tolerance_db = 10.0;
  double tolerance_opacity = 0.1;
  double margin_db = 3.0;
  int reach_pings = 30;
  bool backwards = true;
  bool forwards = true;
};

template <class Visitor>
void describe(Visitor& v, SelectParams& p) {
  v.choice("mode", p.mode, kGrowModeNames, "tracked: down from the reference in dB; paper: both ways in opacity");
  v.choice("connectivity", p.connectivity, kConnectivityNames, "neighbours of a voxel: 6 faces or all 26");
  v.field("tolerance_db", p.tolerance_db,
          {.unit = "dB", .min = 3, .max = 25, .text = "how far below the reference level members may lie"});
  v.field("tolerance_opacity", p.tolerance_opacity,
          {.unit = "1", .min = 0, .max = 1, .text = "mode paper: largest difference in opacity from the seed"});
  v.field("margin_db", p.margin_db,
          {.unit = "dB",
           .min = 0,
           .max = 30,
           .text = "mode tracked: how far above the beam's noise members must lie; 0 = ignore the noise"});
  v.field("reach_pings", p.reach_pings,
          {.unit = "pings", .min = 1, .max = 100000, .text = "how far a school is followed to each side"});
  v.field("backwards", p.backwards, {.text = "follow a school to earlier pings"});
  v.field("forwards", p.forwards, {.text = "follow a school to later pings"});
}

/// Which views are switched on; one that is off costs nothing.
struct ViewSwitches {
  bool top_slice = true;
  bool side_slice = true;
  bool volume = true;
  bool observation_map = true;
  bool propagation = true;
  bool survey_map = true;
  bool timeline = true;
  bool echogram = true;
  bool range_slice = false;
  bool plane_slice = false;
  bool chart = true;
  bool noise_steps = false;
  bool frequency = false;
  bool lineage = false;
  bool curves = false;
};

template <class Visitor>
void describe(Visitor& v, ViewSwitches& p) {
  v.field("top_slice", p.top_slice, {.text = "the slice from above"});
  v.field("side_slice", p.side_slice, {.text = "the slice from the side"});
  v.field("volume", p.volume, {.text = "the view in three dimensions"});
  v.field("observation_map", p.observation_map, {.text = "the map of the observation"});
  v.field("propagation", p.propagation, {.text = "the strip of neighbouring pings"});
  v.field("survey_map", p.survey_map, {.text = "the map of the survey"});
  v.field("timeline", p.timeline, {.text = "the timeline"});
  v.field("echogram", p.echogram, {.text = "the echogram of one beam, fan or channel"});
  v.field("range_slice", p.range_slice, {.text = "the slice at one range"});
  v.field("plane_slice", p.plane_slice, {.text = "the slice along any plane"});
  v.field("chart", p.chart, {.text = "the chart of schools' figures"});
  v.field("frequency", p.frequency, {.text = "the chart of schools over the frequencies of the fans"});
  v.field("noise_steps", p.noise_steps, {.text = "the slice at each step of noise removal"});
  v.field("lineage", p.lineage, {.text = "what became of the observation's schools"});
  v.field("curves", p.curves,
          {.text = "curves of schools: Sv in them, their size over the tolerance, or against the ship"});
}

}  // namespace sonar
