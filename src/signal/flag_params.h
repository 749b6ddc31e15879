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
  v.field("enabled", p.enabled,
          {.text = "Flag samples near the transducer, where its ringing hides the water; switch it off for recordings "
                   "that begin beyond the ringing."});
  v.field("range_m", p.range_m,
          {.unit = "m",
           .min = 0,
           .max = 1000,
           .text = "Samples nearer to the transducer than this are flagged as near field; raise it where ringing is "
                   "seen farther out.",
           .tier = Tier::basic});
}

template <class Visitor>
void describe(Visitor& v, SurfaceParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Flag samples with echo of the sea surface; switch it off to look for schools right below the "
                   "surface. Samples above the water line are flagged in any case."});
  v.choice("mode", p.mode, kSurfaceModeNames,
           "How the surface is found: fan flags the topmost fans as a whole, edge flags each beam from where its upper "
           "-3 dB edge reaches the surface. Choose fan where transducer depth or beam widths are not well known.");
  v.field("fans", p.fans,
          {.unit = "fans",
           .min = 0,
           .max = 1000,
           .text = "Mode fan: number of topmost fans that are flagged as surface; raise it where lower fans show the "
                   "surface too."});
  v.field(
      "margin_m", p.margin_m,
      {.unit = "m",
       .min = 0,
       .max = 100,
       .text = "Mode edge: depth of the water below the sea surface that is flagged with it; raise it in rough seas.",
       .tier = Tier::basic});
}

template <class Visitor>
void describe(Visitor& v, DropoutParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Flag dropouts: samples that stay constant along range or repeat the beam beside them; switch it "
                   "off for data in which quiet water is stored as one constant value."});
  v.field("minimum_samples", p.minimum_samples,
          {.unit = "samples",
           .min = 8,
           .max = 100000,
           .text = "Least length of a dropout along range; lower it where shorter dropouts remain, raise it if quiet "
                   "water is flagged."});
}

template <class Visitor>
void describe(Visitor& v, CorruptedPacketParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Flag corrupted packets: stretches of single beams at a high level with sharp ends; switch it off "
                   "if schools are flagged in data without damaged packets."});
  v.field("threshold_db", p.threshold_db,
          {.unit = "dB",
           .min = 1,
           .max = 100,
           .text = "Corrupted packets lie at least this much above the median of the 8 neighbouring beams, and step by "
                   "as much at both ends; raise it if parts of schools are flagged."});
  v.field(
      "neighbour_db", p.neighbour_db,
      {.unit = "dB",
       .min = 0,
       .max = 100,
       .text =
           "Corrupted packets lie at least this much above the beams directly above and below (in a sonar of one fan, "
           "beside them); raise it if parts of schools are flagged, lower it if damage in adjoining fans remains."});
  v.field(
      "beam_spread_db", p.beam_spread_db,
      {.unit = "dB",
       .min = 0,
       .max = 100,
       .text = "A beam that is loud all along must exceed its neighbours by this much more than a shorter stretch "
               "of corrupted packets, since beams differ in gain; raise it if undamaged beams are flagged, lower it if "
               "loud ones remain."});
  v.field("block_samples", p.block_samples,
          {.unit = "samples",
           .min = 8,
           .max = 1024,
           .text = "Length of the blocks of range over which levels are averaged to find corrupted packets; lower it "
                   "where short ones remain, raise it if speckle is flagged."});
  v.field("minimum_samples", p.minimum_samples,
          {.unit = "samples",
           .min = 8,
           .max = 100000,
           .text = "Least length of corrupted packets along range; lower it if shorter ones remain, raise it if short "
                   "loud echoes are flagged."});
  v.field(
      "block_sound_share", p.block_sound_share,
      {.unit = "1",
       .min = 0,
       .max = 1,
       .text = "Least share of unflagged samples in a block of range for the block to be searched for corrupted "
               "packets; lower it where many samples carry other flags, raise it if a few samples decide wrongly."});
  v.field("background_share", p.background_share,
          {.unit = "1",
           .min = 0,
           .max = 0.99,
           .text = "Share of a beam's blocks of range that lie below its own background, above which corrupted packets "
                   "must rise; lower it where loud stretches fill most of a beam."});
  v.field(
      "beside_beams", p.beside_beams,
      {.unit = "beams",
       .min = 1,
       .max = 100,
       .text = "How many beams of the same fan on either side a beam is compared with to find corrupted packets; raise "
               "it where damaged beams lie close together, lower it where the level changes much across a fan."});
  v.field("edge_samples", p.edge_samples,
          {.unit = "samples",
           .min = 1,
           .max = 1000,
           .text = "Number of samples before and after an end of corrupted packets over which the step is averaged; "
                   "raise it where speckle hides the step, lower it for short packets."});
  v.field("tail_samples", p.tail_samples,
          {.unit = "samples",
           .min = 0,
           .max = 1000,
           .text = "How many samples a blurred end of corrupted packets may reach beyond its step; raise it where loud "
                   "samples remain at the ends, lower it if schools next to the ends are flagged."});
  v.field("margin_samples", p.margin_samples,
          {.unit = "samples",
           .min = 0,
           .max = 1000,
           .text = "How many samples beyond either end of corrupted packets are flagged with them; raise it where "
                   "blurred samples remain at the ends."});
  v.field(
      "separate_beams_db", p.separate_beams_db,
      {.unit = "dB",
       .min = 0,
       .max = 60,
       .text =
           "Where the next fan hears a target weaker by more than this because the beams lie far apart, the thresholds "
           "for corrupted packets rise by this loss; lower it if schools that a single fan sees are flagged."});
}

template <class Visitor>
void describe(Visitor& v, InterferenceParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Flag interference at constant range: a high level in most beams at once; switch it off if layers "
                   "or schools are flagged though no other sounder was running."});
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
           .text = "Interference in a single fan lies at least this much above the running median over range; lower it "
                   "if interference in single fans remains, raise it if wide schools are flagged."});
  v.field("beam_fraction", p.beam_fraction,
          {.unit = "",
           .min = 0.5,
           .max = 1,
           .text = "Least share of a fan's beams in which interference is heard; lower it if interference that only "
                   "some beams hear remains, raise it if wide schools are flagged."});
  v.field("maximum_samples", p.maximum_samples,
          {.unit = "samples",
           .min = 1,
           .max = 100,
           .text = "Greatest thickness of interference along range, since fish and seabed are thicker; raise it where "
                   "long pulses of another sounder remain, lower it if thin layers are flagged."});
  v.field("window_samples", p.window_samples,
          {.unit = "samples",
           .min = 4,
           .max = 1000,
           .text = "Half length along range of the running median with which interference is compared; raise it where "
                   "thick interference remains, lower it where the level changes fast with range."});
  v.field("minimum_beams", p.minimum_beams,
          {.unit = "beams",
           .min = 1,
           .max = 1000,
           .text = "Least number of unflagged beams in a fan for interference to be looked for; lower it for sonars "
                   "with few beams in a fan."});
  v.field(
      "gap_samples", p.gap_samples,
      {.unit = "samples",
       .min = 0,
       .max = 100,
       .text =
           "Quiet gaps of up to this many samples do not end a stretch of interference, since speckle may hide part of "
           "it; raise it where interference with gaps remains, lower it where separate echoes are joined."});
  v.field("shoulder_near_samples", p.shoulder_near_samples,
          {.unit = "samples",
           .min = 1,
           .max = 100,
           .text = "Distance from interference at which its own blurred edge ends and the water beside it must be "
                   "quiet; raise it where interference with wide, soft edges remains."});
  v.field("shoulder_far_samples", p.shoulder_far_samples,
          {.unit = "samples",
           .min = 1,
           .max = 100,
           .text = "Distance from interference up to which the water beside it must be quiet; lower it where "
                   "interference close to other echoes remains, raise it if schools are flagged."});
  v.field(
      "tapered_share", p.tapered_share,
      {.unit = "1",
       .min = 0,
       .max = 1,
       .text =
           "An echo is a school, not interference, where the share of loud beams right before or behind it exceeds "
           "that farther off by more than this; lower it if schools are flagged, raise it if interference remains."});
  v.field("margin_samples", p.margin_samples,
          {.unit = "samples",
           .min = 0,
           .max = 100,
           .text = "How many samples before and after interference are flagged with it; raise it where its blurred "
                   "edges remain."});
}

template <class Visitor>
void describe(Visitor& v, ImpulseParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Flag impulse noise: peaks of up to 3 samples in one beam of one ping; switch it off if single fish "
                   "near the sonar are flagged."});
  v.field("threshold_db", p.threshold_db,
          {.unit = "dB",
           .min = 1,
           .max = 100,
           .text = "Impulse noise lies at least this much above everything around it; raise it if fish near the sonar "
                   "are flagged, lower it if weak peaks remain."});
  v.field("beam_reach_samples", p.beam_reach_samples,
          {.unit = "samples",
           .min = 0,
           .max = 100,
           .text = "A peak is not impulse noise if a neighbouring beam shows it within this many samples of its range; "
                   "raise it if single fish are flagged, lower it if impulse noise close to other echoes remains."});
  v.field("ping_reach_samples", p.ping_reach_samples,
          {.unit = "samples",
           .min = 0,
           .max = 100,
           .text = "A peak is not impulse noise if the ping before or after shows it within this many samples of its "
                   "range; raise it for a fast ship, which moves farther between pings."});
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
