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
  double block_sound_share = 0.5;
  double background_share = 0.25;
  int beside_beams = 3;
  int edge_samples = 8;
  int tail_samples = 16;
  int margin_samples = 1;
  double separate_beams_db = 10.0;
};

struct WallParams {
  bool enabled = true;
  double threshold_db = 6.0;
  double fan_threshold_db = 10.0;
  double beam_fraction = 0.75;
  int maximum_samples = 16;
  int window_samples = 32;
  int minimum_beams = 8;
  int gap_samples = 2;
  int shoulder_near_samples = 2;
  int shoulder_far_samples = 4;
  double tapered_share = 0.25;
  int margin_samples = 1;
};

struct ImpulseParams {
  bool enabled = true;
  double threshold_db = 10.0;
  int beam_reach_samples = 1;
  int ping_reach_samples = 3;
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
  v.field("block_sound_share", p.block_sound_share,
          {.unit = "1", .min = 0, .max = 1, .text = "blocks with a smaller share of sound samples are not judged"});
  v.field("background_share", p.background_share,
          {.unit = "1", .min = 0, .max = 0.99, .text = "a beam's own background: this share of its blocks lies below"});
  v.field("beside_beams", p.beside_beams,
          {.unit = "beams", .min = 1, .max = 100, .text = "so many beams of its own fan on either side are looked at"});
  v.field("edge_samples", p.edge_samples,
          {.unit = "samples", .min = 1, .max = 1000, .text = "the step at an edge is taken over this on either side"});
  v.field("tail_samples", p.tail_samples,
          {.unit = "samples", .min = 0, .max = 1000, .text = "how far a blurred edge may reach"});
  v.field("margin_samples", p.margin_samples,
          {.unit = "samples", .min = 0, .max = 1000, .text = "flagged beyond either end"});
  v.field("separate_beams_db", p.separate_beams_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "where the next fan sees a target weaker than this, more than that is asked for"});
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
  v.field("gap_samples", p.gap_samples,
          {.unit = "samples", .min = 0, .max = 100, .text = "speckle may break a wall by this"});
  v.field("shoulder_near_samples", p.shoulder_near_samples,
          {.unit = "samples", .min = 1, .max = 100, .text = "beside a wall its own blurred edge ends here ..."});
  v.field("shoulder_far_samples", p.shoulder_far_samples,
          {.unit = "samples", .min = 1, .max = 100, .text = "... and the water beside it is judged up to here"});
  v.field("tapered_share", p.tapered_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "so many more of the beams loud beside it than farther off make a rounded body, no wall"});
  v.field("margin_samples", p.margin_samples,
          {.unit = "samples", .min = 0, .max = 100, .text = "flagged beyond either side"});
}

template <class Visitor>
void describe(Visitor& v, ImpulseParams& p) {
  v.field("enabled", p.enabled, {.text = "flag peaks of up to 3 samples in one beam"});
  v.field("threshold_db", p.threshold_db, {.unit = "dB", .min = 1, .max = 100, .text = "above everything around"});
  v.field("beam_reach_samples", p.beam_reach_samples,
          {.unit = "samples", .min = 0, .max = 100, .text = "around: in the neighbouring beams"});
  v.field("ping_reach_samples", p.ping_reach_samples,
          {.unit = "samples", .min = 0, .max = 100, .text = "around: in the pings before and after, as ships move"});
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
