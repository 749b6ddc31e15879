// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/describe.h"
#include "school/grow.h"

namespace sonar {

struct DetectParams {
  double floor_db = -60.0;
  double background_margin_db = 8.0;
  double water_share = 0.3;
  double water_open_share = 0.3;
  double water_above_noise_db = 1.0;
  double noise_sigmas = 4.25;
  double noise_low_percentile = 16.0;
  double noise_most_db = 6.0;
  int noise_min_samples = 1000;
  double reference_percentile = 90.0;
  double tolerance_db = 10.0;
  double link_db = 3.0;
  double step_db = 3.0;
  double min_prominence_db = 6.0;
  double background_rest_db = 1.5;
  double min_range_m = 5.0;
  int min_samples = 4;
  int min_beams = 2;
  int min_fans = 2;
  double max_flagged_members = 0.5;
  double max_boundary_faces = 0.3;
  double max_seabed_faces = 0.4;
  double seabed_rise_db = 0.0;
  double min_free_share = 0.5;
  double max_shell_thickness_m = 8.0;
  double shell_share = 0.9;
  double shell_bend = 2.0;
  double front_share = 0.01;
  double front_most = 0.8;
  int front_beams = 8;
  int front_rows = 12;
  double side_lobe_rise_db = 4.0;
  double side_lobe_share = 0.25;
  double side_lobe_below_db = 12.0;
  int side_lobe_fans = 4;
  double side_lobe_known_share = 0.5;
  double ring_rise_db = 3.0;
  double ring_water_first = 0.15;
  double ring_water_end = 0.06;
  double ring_before = 0.03;
  double ring_reach = 0.07;
  double ring_inside_share = 0.6;
  double ring_clear_db = 12.0;
  int floor_beams = 8;
  double floor_echo_db = -30.0;
  double floor_flat_share = 0.06;
  double record_end_share = 0.025;
  int record_end_samples = 2;
  double cut_off_share = 0.5;
  int member_samples = 23;
  double member_percentile = 92.0;
  double peak_percentile = 99.5;
  double peak_above_db = 1.5;
  int peak_filter_rows = 9;
  double min_valley_db = 5.0;
  double valley_step_db = 1.0;
  double crown_share = 0.5;
  int rim_fans = 1;
  int rim_beams = 1;
  int rim_samples = 15;
  int max_rims = 2;
  int search_fans = 2;
  int search_beams = 3;
  int search_samples = 40;
  int max_searches = 6;
  double human_share = 0.25;
  Connectivity connectivity = Connectivity::faces;
};

template <class Visitor>
void describe(Visitor& v, DetectParams& p) {
  v.field("floor_db", p.floor_db, {.unit = "dB re 1 m-1", .min = -120, .max = 0, .text = "lowest Sv of a candidate"});
  v.field("background_margin_db", p.background_margin_db,
          {.unit = "dB", .min = 0, .max = 60, .text = "candidates lie so far above the background"});
  v.field(
      "water_share", p.water_share,
      {.unit = "1",
       .min = 0,
       .max = 1,
       .text = "the water's own level at a range is background too: above this share of the beams; 0 = not looked at"});
  v.field("water_open_share", p.water_open_share,
          {.unit = "1", .min = 0, .max = 1, .text = "... where so many beams are open; fewer could be one school's"});
  v.field("water_above_noise_db", p.water_above_noise_db,
          {.unit = "dB", .min = 0, .max = 60, .text = "... and louder by this than their own filtered noise"});
  v.field("noise_sigmas", p.noise_sigmas,
          {.unit = "1",
           .min = 0,
           .max = 20,
           .text = "noise that fluctuates more raises the margin: so many of its own spreads above its median"});
  v.field("noise_low_percentile", p.noise_low_percentile,
          {.unit = "%",
           .min = 0,
           .max = 50,
           .text = "... a spread being from its median down to where this share of it lies below"});
  v.field("noise_most_db", p.noise_most_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "... by this at most: what fluctuates more is no noise, or was not filtered"});
  v.field("noise_min_samples", p.noise_min_samples,
          {.unit = "samples", .min = 1, .max = 1000000, .text = "... told from so many samples or more"});
  v.field("reference_percentile", p.reference_percentile,
          {.unit = "%", .min = 1, .max = 100, .text = "a school's reference: this share of the candidate lies below"});
  v.field("tolerance_db", p.tolerance_db,
          {.unit = "dB", .min = 0.1, .max = 60, .text = "members lie no deeper below the school's reference"});
  v.field(
      "link_db", p.link_db,
      {.unit = "dB", .min = 0, .max = 30, .text = "parts joined by echo this far below the threshold are one school"});
  v.field(
      "step_db", p.step_db,
      {.unit = "dB", .min = 0.5, .max = 30, .text = "steps in which weaker schools beside a strong one are sought"});
  v.field("min_prominence_db", p.min_prominence_db,
          {.unit = "dB", .min = 0, .max = 60, .text = "a weaker school stands so far above where it meets a stronger"});
  v.field("background_rest_db", p.background_rest_db,
          {.unit = "dB", .min = 0, .max = 60, .text = "members stand so far above the background"});
  v.field("min_range_m", p.min_range_m, {.unit = "m", .min = 0, .max = 500, .text = "least extent along range"});
  v.field("min_samples", p.min_samples,
          {.unit = "samples", .min = 1, .max = 10000, .text = "least extent along range"});
  v.field("min_beams", p.min_beams, {.unit = "beams", .min = 1, .max = 1000, .text = "least number of beams"});
  v.field("min_fans", p.min_fans, {.unit = "fans", .min = 1, .max = 1000, .text = "least number of fans"});
  v.field("max_flagged_members", p.max_flagged_members,
          {.unit = "1", .min = 0, .max = 1, .text = "no school where more of the members are faulty samples"});
  v.field("max_boundary_faces", p.max_boundary_faces,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "no school where more of the outer faces lie at the surface or the near field"});
  v.field("max_seabed_faces", p.max_seabed_faces,
          {.unit = "1", .min = 0, .max = 1, .text = "largest share of outer faces at the seabed's margin"});
  v.field("seabed_rise_db", p.seabed_rise_db,
          {.unit = "dB",
           .min = -60,
           .max = 60,
           .text = "the seabed's own flank, not a school: members beside its margin are this much above the others"});
  v.field("min_free_share", p.min_free_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "... or a school's with that flank below it, which is left out where at least this share remains"});
  v.field("max_shell_thickness_m", p.max_shell_thickness_m,
          {.unit = "m", .min = 0, .max = 100, .text = "what is thinner and spans the shell_share is a wall"});
  v.field("shell_share", p.shell_share,
          {.unit = "1", .min = 0, .max = 1, .text = "share of all beams at constant range that makes a wall"});
  v.field("shell_bend", p.shell_bend,
          {.unit = "1",
           .min = 1,
           .max = 100,
           .text = "a wall's whole extent along range stays below so many max_shell_thickness_m"});
  v.field("front_share", p.front_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "another sonar's pulse: its ranges lie within this share of its width across; 0 = not looked at"});
  v.field("front_most", p.front_most,
          {.unit = "1", .min = 0.1, .max = 1, .text = "... the middle ones, so large a share of all its beams"});
  v.field("front_beams", p.front_beams,
          {.unit = "beams",
           .min = 2,
           .max = 1000,
           .text = "... side by side, or so many fans, where middles alone tell; both edges tell in any case"});
  v.field("front_rows", p.front_rows,
          {.unit = "beams", .min = 2, .max = 100000, .text = "... of so many beams in all"});
  v.field("side_lobe_rise_db", p.side_lobe_rise_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "what stands out less of the other beams of its fans may be a side lobe; 0 = nothing is"});
  v.field(
      "side_lobe_share", p.side_lobe_share,
      {.unit = "1", .min = 0, .max = 1, .text = "share of a fan's beams below the level that it must stand out of"});
  v.field("side_lobe_below_db", p.side_lobe_below_db,
          {.unit = "dB",
           .min = 0,
           .max = 100,
           .text = "the seabed's echo, and the surface's, is so much stronger than its side lobes"});
  v.field("side_lobe_fans", p.side_lobe_fans,
          {.unit = "fans", .min = 0, .max = 1000, .text = "... the surface's in fans no further off than this"});
  v.field("side_lobe_known_share", p.side_lobe_known_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "... judged where so large a share of those beams, or of the voxels, is known"});
  v.field("ring_rise_db", p.ring_rise_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "where fans become so much louder at the seabed's nearest range they hear it there; 0 = never"});
  v.field("ring_water_first", p.ring_water_first,
          {.unit = "1", .min = 0, .max = 1, .text = "... than in the water from this share of the range before it"});
  v.field("ring_water_end", p.ring_water_end,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "... to this share before it: the filter spreads the ring over what is nearer"});
  v.field("ring_before", p.ring_before,
          {.unit = "1", .min = 0, .max = 0.5, .text = "... the ring goes from this share of the range before it"});
  v.field("ring_reach", p.ring_reach,
          {.unit = "1", .min = 0, .max = 0.5, .text = "... to this share of the range behind it"});
  v.field(
      "ring_inside_share", p.ring_inside_share,
      {.unit = "1", .min = 0, .max = 1, .text = "... and what lies there with this share of its voxels is no school"});
  v.field("ring_clear_db", p.ring_clear_db,
          {.unit = "dB", .min = 0, .max = 100, .text = "... unless it stands so far out of its fans"});
  v.field("floor_beams", p.floor_beams,
          {.unit = "beams", .min = 1, .max = 1000, .text = "a school may fill fans of fewer beams; no seabed there"});
  v.field("floor_echo_db", p.floor_echo_db,
          {.unit = "dB re 1 m-1",
           .min = -100,
           .max = 0,
           .text = "what fills the lowest fan at one range and is stronger is the seabed"});
  v.field("floor_flat_share", p.floor_flat_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "ranges this near to their median, as a share of it, are one range: slope and roll included"});
  v.field("record_end_share", p.record_end_share,
          {.unit = "1", .min = 0, .max = 0.5, .text = "last share of the samples, where the record cuts echo off"});
  v.field("record_end_samples", p.record_end_samples,
          {.unit = "samples", .min = 1, .max = 10000, .text = "... or at least so many"});
  v.field(
      "cut_off_share", p.cut_off_share,
      {.unit = "1", .min = 0, .max = 1, .text = "share of a fan's sound beams as loud there that makes it the seabed"});
  v.field("member_samples", p.member_samples,
          {.unit = "samples",
           .min = 0,
           .max = 1001,
           .text = "what of a school's water is it: by a median along each beam of so many; 0 = by the filtered data"});
  v.field("member_percentile", p.member_percentile,
          {.unit = "%",
           .min = 1,
           .max = 100,
           .text = "the reference of these medians: this share of the school lies below"});
  v.field("peak_percentile", p.peak_percentile,
          {.unit = "%",
           .min = 0,
           .max = 100,
           .text = "share of a school's filtered voxels below its peak; 0 = no school has one"});
  v.field("peak_above_db", p.peak_above_db,
          {.unit = "dB", .min = 0, .max = 20, .text = "the reference lies so far above the filtered peak at least"});
  v.field("peak_filter_rows", p.peak_filter_rows,
          {.unit = "beams",
           .min = 1,
           .max = 1000,
           .text = "... where the median filter looks at so many beams; with fewer the loudest voxels are fading"});
  v.field("min_valley_db", p.min_valley_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "two schools that the filter had joined: both stand so far above the valley between them"});
  v.field("valley_step_db", p.valley_step_db,
          {.unit = "dB", .min = 0.1, .max = 30, .text = "... which is sounded in such steps"});
  v.field("crown_share", p.crown_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "... and are as large as a school has to be so far up from it to their tops"});
  v.field("rim_fans", p.rim_fans,
          {.unit = "fans", .min = 0, .max = 100, .text = "members lie no farther outside what the filtered data show"});
  v.field(
      "rim_beams", p.rim_beams,
      {.unit = "beams", .min = 0, .max = 100, .text = "members lie no farther outside what the filtered data show"});
  v.field(
      "rim_samples", p.rim_samples,
      {.unit = "samples", .min = 0, .max = 1000, .text = "members lie no farther outside what the filtered data show"});
  v.field("max_rims", p.max_rims,
          {.unit = "1", .min = 1, .max = 100, .text = "... so many times that beside a louder neighbour"});
  v.field("search_fans", p.search_fans,
          {.unit = "fans", .min = 0, .max = 1000, .text = "a candidate's school is sought so far beyond its box"});
  v.field("search_beams", p.search_beams,
          {.unit = "beams", .min = 0, .max = 1000, .text = "a candidate's school is sought so far beyond its box"});
  v.field("search_samples", p.search_samples,
          {.unit = "samples", .min = 0, .max = 100000, .text = "a candidate's school is sought so far beyond its box"});
  v.field("max_searches", p.max_searches,
          {.unit = "1", .min = 0, .max = 1000, .text = "... and so many times that farther where a neighbour goes on"});
  v.field("human_share", p.human_share,
          {.unit = "1",
           .min = 0,
           .max = 1,
           .text = "a detection that shares more of the smaller mask with a human's school is that school"});
  v.choice("connectivity", p.connectivity, kConnectivityNames, "neighbours of a voxel: 6 faces or all 26");
}

/// The parameters for data that the median filter looked at so many rows of beams for: of one or a few, the loudest
/// voxels are not a school's peak but its fading, so that none has one.
[[nodiscard]] DetectParams for_filter(const DetectParams& params, int rows);

/// Sv counts of the quietest background that matters: from a quieter one candidates lie above the floor anyhow.
[[nodiscard]] int least_background(const DetectParams& params);

}  // namespace sonar
