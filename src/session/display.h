// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"
#include "pipeline/recipe/recipe.h"
#include "view/sv_scale.h"

namespace sonar {

enum class NoiseLook : std::uint8_t { shown, hatched, transparent };
inline constexpr std::array<std::string_view, 3> kNoiseLookNames{"shown", "hatched", "transparent"};

/// Which samples noise removal takes out of the pictures; growing keeps to the recipe.
struct TakenOut {
  bool near_field = true;
  bool surface = true;
  bool corrupted_packets = true;
  bool interference = true;
  bool impulses = true;
  bool seabed = true;
};

template <class Visitor>
void describe(Visitor& v, TakenOut& p) {
  v.field("near_field", p.near_field, {.text = "take ringing near the transducer out of the pictures"});
  v.field("surface", p.surface, {.text = "take the sea surface out of the pictures"});
  v.field("corrupted_packets", p.corrupted_packets,
          {.text = "take stretches of corrupted packets out of the pictures"});
  v.field("interference", p.interference, {.text = "take interference at constant range out of the pictures"});
  v.field("impulses", p.impulses, {.text = "take impulse noise out of the pictures"});
  v.field("seabed", p.seabed, {.text = "take the seabed and what lies behind out of the pictures"});
}

/// How data and schools look in every view.
struct DisplayParams {
  SvScale scale;
  bool filtered = false;
  TakenOut take_out;
  NoiseLook removed = NoiseLook::hatched;
  NoiseLook weak = NoiseLook::transparent;
  double weak_below_db = 3.0;
  bool masks = true;
  double core_at = 0.64;
  double fuzzy_above = 0.0;
  bool rejected = true;
  bool refused_echoes = true;
  bool grid_lines = false;
  bool north_up = false;
};

template <class Visitor>
void describe(Visitor& v, DisplayParams& p) {
  v.group("scale", p.scale, "how Sv becomes colour");
  v.field("filtered", p.filtered,
          {.text = "slices show Sv after the median filter, on which schools are grown; off = as recorded"});
  v.group("take_out", p.take_out, "what noise removal takes out");
  v.choice("removed", p.removed, kNoiseLookNames, "how samples that noise removal took out look");
  v.choice("weak", p.weak, kNoiseLookNames, "how samples that hardly rise above the noise look");
  v.field("weak_below_db", p.weak_below_db,
          {.unit = "dB", .min = 0, .max = 30, .text = "a sample with less signal-to-noise is weak"});
  v.field("masks", p.masks, {.text = "show schools over the data"});
  v.field("core_at", p.core_at, {.unit = "1", .min = 0.01, .max = 1, .text = "confidence from which a voxel is core"});
  v.field("fuzzy_above", p.fuzzy_above,
          {.unit = "1", .min = 0, .max = 0.99, .text = "confidence above which a voxel belongs to the fuzzy area"});
  v.field("rejected", p.rejected, {.text = "show rejected schools too, in grey"});
  v.field("refused_echoes", p.refused_echoes,
          {.text = "mark the echoes above the background that were judged no schools; hover says why"});
  v.field("grid_lines", p.grid_lines, {.text = "lines of the axes across slices"});
  v.field("north_up", p.north_up, {.text = "north points up in slices from above; off = the bow does"});
}

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

enum class VolumeMode : std::uint8_t { accumulate, first_hit, maximum };
inline constexpr std::array<std::string_view, 3> kVolumeModeNames{"accumulate", "first_hit", "maximum"};
enum class VolumeRendererName : std::uint8_t { automatic, cpu, gl };
inline constexpr std::array<std::string_view, 3> kVolumeRendererNames{"automatic", "cpu", "gl"};

/// How the volume is drawn.
struct VolumeParams {
  VolumeMode mode = VolumeMode::accumulate;
  double first_hit_db = -50.0;
  bool lighting = false;
  bool data = true;
  bool filtered = true;
  bool mask_outline = false;
  bool context = true;
  double moving_budget_ms = 50.0;
  int frames = 16;
  VolumeRendererName renderer = VolumeRendererName::automatic;
};

template <class Visitor>
void describe(Visitor& v, VolumeParams& p) {
  v.choice("mode", p.mode, kVolumeModeNames, "how the samples along a ray become a colour");
  v.field("first_hit_db", p.first_hit_db,
          {.unit = "dB", .min = -120, .max = 0, .text = "mode first_hit: the surface lies where Sv reaches this"});
  v.field("lighting", p.lighting, {.text = "light surfaces by the gradient of Sv"});
  v.field("data", p.data, {.text = "show the water; off = schools alone"});
  v.field("filtered", p.filtered, {.text = "show Sv after the median filter, without speckle; off = as recorded"});
  v.field("mask_outline", p.mask_outline,
          {.text = "schools as outlines, so that the data keeps its colours; first hit and maximum have them always"});
  v.field("context", p.context, {.text = "show the sector's frame, range rings, sea surface and ship"});
  v.field("moving_budget_ms", p.moving_budget_ms,
          {.unit = "ms", .min = 5, .max = 2000, .text = "what a picture may take while something moves"});
  v.field("frames", p.frames,
          {.unit = "1", .min = 0, .max = 64, .text = "pictures that are averaged at rest: sampling quality"});
  v.choice("renderer", p.renderer, kVolumeRendererNames, "what draws: the processor (cpu) or the graphics card (gl)");
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
}

}  // namespace sonar
