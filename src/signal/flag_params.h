// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "base/describe.h"

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

struct DropoutParams {
  bool enabled = true;
  int minimum_samples = 64;
};

struct CorruptedPacketParams {
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

struct InterferenceParams {
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
  DropoutParams dropouts;
  CorruptedPacketParams corrupted_packets;
  InterferenceParams interference;
  ImpulseParams impulse_noise;
};

template <class Visitor>
void describe(Visitor& v, NearFieldParams& p) {
  v.field("enabled", p.enabled, {.text = "Flag samples near the transducer, where its ringing hides the water."});
  v.field("range_m", p.range_m,
          {.unit = "m",
           .min = 0,
           .max = 1000,
           .text = "Samples nearer than this are flagged; raise it where ringing is seen farther out.",
           .tier = Tier::basic});
}

template <class Visitor>
void describe(Visitor& v, SurfaceParams& p) {
  v.field("enabled", p.enabled, {.text = "Flag the sea surface and what lies above it."});
  v.choice("mode", p.mode, kSurfaceModeNames,
           "How the surface is found: fan flags the topmost fans as a whole, edge flags each beam from where its upper "
           "-3 dB edge reaches the surface.");
  v.field("fans", p.fans,
          {.unit = "fans", .min = 0, .max = 1000, .text = "Mode fan: number of topmost fans that are flagged."});
  v.field("margin_m", p.margin_m,
          {.unit = "m",
           .min = 0,
           .max = 100,
           .text = "Mode edge: depth below the surface that is flagged too; raise it in rough seas.",
           .tier = Tier::basic});
}

template <class Visitor>
void describe(Visitor& v, DropoutParams& p) {
  v.field("enabled", p.enabled, {.text = "Flag dropouts: samples that stay constant or repeat."});
  v.field("minimum_samples", p.minimum_samples,
          {.unit = "samples", .min = 8, .max = 100000, .text = "Shorter dropouts are left alone."});
}

template <class Visitor>
void describe(Visitor& v, CorruptedPacketParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Flag corrupted packets: stretches of single beams at a high level with sharp ends."});
  v.field("threshold_db", p.threshold_db,
          {.unit = "dB",
           .min = 1,
           .max = 100,
           .text = "A stretch lies at least this much above the median of its 8 neighbours, and steps by as much at "
                   "both ends; raise it if parts of schools are flagged."});
  v.field("neighbour_db", p.neighbour_db,
          {.unit = "dB",
           .min = 0,
           .max = 100,
           .text = "A stretch lies at least this much above each of its two nearest neighbours."});
  v.field(
      "beam_spread_db", p.beam_spread_db,
      {.unit = "dB",
       .min = 0,
       .max = 100,
       .text = "A whole beam must exceed its neighbours by this more than a stretch, since beams may differ in gain."});
  v.field("block_samples", p.block_samples,
          {.unit = "samples",
           .min = 8,
           .max = 1024,
           .text = "Length of the blocks of range over which medians are taken."});
  v.field("minimum_samples", p.minimum_samples,
          {.unit = "samples",
           .min = 8,
           .max = 100000,
           .text = "Shorter stretches are left alone; lower it if short ones remain."});
  v.field("block_sound_share", p.block_sound_share,
          {.unit = "1", .min = 0, .max = 1, .text = "Blocks with a smaller share of sound samples are not judged."});
  v.field("background_share", p.background_share,
          {.unit = "1",
           .min = 0,
           .max = 0.99,
           .text = "Share of a beam's blocks that lie below its own background level."});
  v.field("beside_beams", p.beside_beams,
          {.unit = "beams",
           .min = 1,
           .max = 100,
           .text = "How many beams of the same fan on either side a beam is compared with."});
  v.field("edge_samples", p.edge_samples,
          {.unit = "samples",
           .min = 1,
           .max = 1000,
           .text = "Number of samples on either side over which the step at an end is measured."});
  v.field(
      "tail_samples", p.tail_samples,
      {.unit = "samples", .min = 0, .max = 1000, .text = "How many samples a blurred end may reach beyond the step."});
  v.field("margin_samples", p.margin_samples,
          {.unit = "samples", .min = 0, .max = 1000, .text = "How many samples beyond either end are flagged too."});
  v.field("separate_beams_db", p.separate_beams_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "Where the next fan sees a target weaker by more than this because the beams lie far apart, the "
                   "threshold is raised by the difference."});
}

template <class Visitor>
void describe(Visitor& v, InterferenceParams& p) {
  v.field("enabled", p.enabled, {.text = "Flag interference at constant range: a high level in most beams at once."});
  v.field("threshold_db", p.threshold_db,
          {.unit = "dB",
           .min = 1,
           .max = 100,
           .text = "Interference lies at least this much above the running median over range, all fans taken together; "
                   "lower it if weak interference remains."});
  v.field("fan_threshold_db", p.fan_threshold_db,
          {.unit = "dB",
           .min = 1,
           .max = 100,
           .text = "Interference in a single fan lies at least this much above the running median over range."});
  v.field("beam_fraction", p.beam_fraction,
          {.unit = "", .min = 0.5, .max = 1, .text = "Share of a fan's beams in which interference is heard."});
  v.field("maximum_samples", p.maximum_samples,
          {.unit = "samples", .min = 1, .max = 100, .text = "Echoes thicker than this are no interference."});
  v.field("window_samples", p.window_samples,
          {.unit = "samples", .min = 4, .max = 1000, .text = "Half length of the running median over range."});
  v.field("minimum_beams", p.minimum_beams,
          {.unit = "beams", .min = 1, .max = 1000, .text = "Fans with fewer sound beams are not judged."});
  v.field(
      "gap_samples", p.gap_samples,
      {.unit = "samples",
       .min = 0,
       .max = 100,
       .text = "Gap of so many samples does not end a stretch of interference, since speckle may hide part of it."});
  v.field("shoulder_near_samples", p.shoulder_near_samples,
          {.unit = "samples",
           .min = 1,
           .max = 100,
           .text = "Distance from interference at which its own blurred edge ends."});
  v.field("shoulder_far_samples", p.shoulder_far_samples,
          {.unit = "samples",
           .min = 1,
           .max = 100,
           .text = "Distance from interference up to which the water beside it is judged."});
  v.field("tapered_share", p.tapered_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "An echo is a rounded body, not interference, where this share of the beams more is loud right "
                   "beside it than farther off."});
  v.field("margin_samples", p.margin_samples,
          {.unit = "samples",
           .min = 0,
           .max = 100,
           .text = "How many samples before and after interference are flagged too."});
}

template <class Visitor>
void describe(Visitor& v, ImpulseParams& p) {
  v.field("enabled", p.enabled, {.text = "Flag impulse noise: peaks of up to 3 samples in one beam of one ping."});
  v.field(
      "threshold_db", p.threshold_db,
      {.unit = "dB",
       .min = 1,
       .max = 100,
       .text =
           "A peak lies at least this much above everything around it; raise it if fish near the sonar are flagged."});
  v.field("beam_reach_samples", p.beam_reach_samples,
          {.unit = "samples",
           .min = 0,
           .max = 100,
           .text = "How many samples before and after a peak are looked at in the neighbouring beams."});
  v.field("ping_reach_samples", p.ping_reach_samples,
          {.unit = "samples",
           .min = 0,
           .max = 100,
           .text = "How many samples before and after a peak are looked at in the pings before and after; raise it for "
                   "a fast ship."});
}

template <class Visitor>
void describe(Visitor& v, FlagParams& p) {
  v.group("near_field", p.near_field, "transducer ringing and self noise");
  v.group("surface", p.surface, "sea surface");
  v.group("dropouts", p.dropouts, "samples that were not recorded");
  v.group("corrupted_packets", p.corrupted_packets, "stretches of single beams with corrupted packets");
  v.group("interference", p.interference, "interference at constant range");
  v.group("impulse_noise", p.impulse_noise, "short peaks in one beam");
}

}  // namespace sonar
