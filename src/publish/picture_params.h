// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "publish/movies/movie_params.h"
#include "publish/picture_kind_params.h"
#include "publish/volumes/volume_params.h"
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
  bool shadow = false;
  double shadow_db = 1.0;
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
           .suits = "slice- volume propagation observation-map noise-steps"});
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
  v.field("shadow", p.shadow,
          {.text = "show what lies in the shadow of the schools that are shown, by the recipe's extinction: hatched in "
                   "slices and echograms, as lines along its beams in the volume",
           .suits = kShown});
  v.field("shadow_db", p.shadow_db,
          {.unit = "dB",
           .min = 0.1,
           .max = 20,
           .text = "two-way loss from which a sample lies in shadow",
           .suits = kShown});
  v.field("grid_lines", p.grid_lines, {.text = "lines of the axes across slices", .flag = "grid", .suits = "slice-"});
  v.field("north_up", p.north_up,
          {.text = "north points up in slices from above; off = the bow does",
           .suits = "slice-top slice-plane noise-steps"});
}

struct PictureParams {
  RangeSliceParams slice_range;
  PlaneSliceParams slice_plane;
  CameraParams volume;
  PropagationParams propagation;
  TimelineParams timeline;
  EchogramParams echogram;
  ChartParams chart;
  FrequencyParams frequency;
  CurvesParams curves;
  NoiseStepsParams noise_steps;
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
  v.group("frequency", p.frequency, "schools over the frequencies of the fans");
  v.group("curves", p.curves, "curves of schools");
  v.group("noise-steps", p.noise_steps, "a slice at each step of noise removal");
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
