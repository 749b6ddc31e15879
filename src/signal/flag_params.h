// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace sonar {

struct NearFieldParams {
  bool enabled = true;
  double range_m = 15.0;
};

enum class SurfaceMode { fan, edge };
inline constexpr std::array<std::string_view, 2> kSurfaceModeNames = {"fan", "edge"};

struct SurfaceParams {
  bool enabled = true;
  SurfaceMode mode = SurfaceMode::edge;
  int fans = 1;
  double margin_m = 2.0;
};

struct LostParams {
  bool enabled = true;
  int minimum_samples = 64;
};

struct HotBeamParams {
  bool enabled = true;
  double threshold_db = 10.0;
  double neighbour_db = 6.0;
  double beam_spread_db = 15.0;
  int block_samples = 64;
  int minimum_samples = 100;
};

struct WallParams {
  bool enabled = true;
  double threshold_db = 6.0;
  double fan_threshold_db = 10.0;
  double beam_fraction = 0.75;
  int maximum_samples = 16;
  int window_samples = 32;
  int minimum_beams = 8;
};

struct ImpulseParams {
  bool enabled = true;
  double threshold_db = 10.0;
};

struct FlagParams {
  NearFieldParams near_field;
  SurfaceParams surface;
  LostParams lost;
  HotBeamParams hot_beam;
  WallParams wall;
  ImpulseParams impulse;
};

template <class Visitor>
void describe(Visitor& v, NearFieldParams& p) {
  v.field("enabled", p.enabled, {.text = "flag samples near the transducer"});
  v.field("range_m", p.range_m, {.unit = "m", .min = 0, .max = 1000, .text = "samples nearer than this"});
}

template <class Visitor>
void describe(Visitor& v, SurfaceParams& p) {
  v.field("enabled", p.enabled, {.text = "flag the sea surface"});
  v.choice("mode", p.mode, kSurfaceModeNames,
           "fan: the topmost fans as a whole; edge: each beam from where its upper -3 dB edge reaches the surface");
  v.field("fans", p.fans, {.unit = "fans", .min = 0, .max = 1000, .text = "mode fan: how many"});
  v.field("margin_m", p.margin_m, {.unit = "m", .min = 0, .max = 100, .text = "mode edge: depth kept clear"});
}

template <class Visitor>
void describe(Visitor& v, LostParams& p) {
  v.field("enabled", p.enabled, {.text = "flag constant and repeated stretches"});
  v.field("minimum_samples", p.minimum_samples,
          {.unit = "samples", .min = 8, .max = 100000, .text = "shorter stretches are left alone"});
}

template <class Visitor>
void describe(Visitor& v, HotBeamParams& p) {
  v.field("enabled", p.enabled, {.text = "flag stretches of single beams at a high level"});
  v.field("threshold_db", p.threshold_db,
          {.unit = "dB", .min = 1, .max = 100, .text = "above the median of the 8 neighbours, and step at both ends"});
  v.field("neighbour_db", p.neighbour_db,
          {.unit = "dB", .min = 0, .max = 100, .text = "above each of the two nearest neighbours"});
  v.field("beam_spread_db", p.beam_spread_db,
          {.unit = "dB", .min = 0, .max = 100, .text = "a whole beam must stand above its neighbours by this more"});
  v.field("block_samples", p.block_samples,
          {.unit = "samples", .min = 8, .max = 1024, .text = "medians are taken over blocks of this length"});
  v.field("minimum_samples", p.minimum_samples,
          {.unit = "samples", .min = 8, .max = 100000, .text = "shorter stretches are left alone"});
}

template <class Visitor>
void describe(Visitor& v, WallParams& p) {
  v.field("enabled", p.enabled, {.text = "flag shells at constant range"});
  v.field("threshold_db", p.threshold_db,
          {.unit = "dB", .min = 1, .max = 100, .text = "above the running median over range, for all fans together"});
  v.field("fan_threshold_db", p.fan_threshold_db,
          {.unit = "dB", .min = 1, .max = 100, .text = "the same for one fan alone"});
  v.field("beam_fraction", p.beam_fraction,
          {.unit = "", .min = 0.5, .max = 1, .text = "share of a fan's beams that must show the wall"});
  v.field("maximum_samples", p.maximum_samples,
          {.unit = "samples", .min = 1, .max = 100, .text = "thicker echoes are no walls"});
  v.field("window_samples", p.window_samples,
          {.unit = "samples", .min = 4, .max = 1000, .text = "half length of the running median"});
  v.field("minimum_beams", p.minimum_beams,
          {.unit = "beams", .min = 1, .max = 1000, .text = "fans with fewer sound beams are not judged"});
}

template <class Visitor>
void describe(Visitor& v, ImpulseParams& p) {
  v.field("enabled", p.enabled, {.text = "flag peaks of up to 3 samples in one beam"});
  v.field("threshold_db", p.threshold_db, {.unit = "dB", .min = 1, .max = 100, .text = "above everything around"});
}

template <class Visitor>
void describe(Visitor& v, FlagParams& p) {
  v.group("near_field", p.near_field, "transducer ringing and self noise");
  v.group("surface", p.surface, "sea surface");
  v.group("lost", p.lost, "samples that were not recorded");
  v.group("hot_beam", p.hot_beam, "lost packets: stretches of single beams at a high level");
  v.group("wall", p.wall, "high level in all beams at constant range");
  v.group("impulse", p.impulse, "short peaks in one beam");
}

}  // namespace sonar
