// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/describe.h"
#include "view/volume/volume_scene.h"

namespace sonar {

inline constexpr std::array<std::string_view, 4> kRayModeNames{"accumulate", "first_hit", "maximum",
                                                               "volume_and_surface"};

/// Which back-end draws volumes.
enum class RendererChoice : std::uint8_t {
  automatic,  ///< OpenGL where it is a real GPU's, else the processor
  cpu,
  gl,
};
inline constexpr std::array<std::string_view, 3> kRendererNames{"auto", "cpu", "gl"};

/// Which schools have a line straight up to the sea surface and down to the seabed.
enum class DropLines : std::uint8_t { none, selected, all };
inline constexpr std::array<std::string_view, 3> kDropLinesNames{"none", "selected", "all"};

/// What of a volume is cut away, so that one looks into it.
enum class VolumeClip : std::uint8_t { none, top_slice, side_slice, both_slices };
inline constexpr std::array<std::string_view, 4> kVolumeClipNames{"none", "top_slice", "side_slice", "both_slices"};

/// How volumes are drawn.
struct VolumeParams {
  RayMode mode = RayMode::accumulate;
  double first_hit_db = -50.0;
  bool lighting = true;
  double occlusion_m = 15.0;
  bool depth_cue = false;
  bool data = true;
  bool filtered = true;
  bool context = true;
  DropLines drop_lines = DropLines::selected;
  bool seabed = true;
  bool current_arrows = true;
  bool slice_planes = true;
  VolumeClip clip = VolumeClip::none;
  bool earth_fixed = false;
  bool ship_track = false;
  bool school_tracks = false;
  bool interpolated = false;
  int trail_pings = 0;
  double ship_length_m = 60.0;
  double moving_budget_ms = 50.0;
  int frames = 16;
  int table_entries = kMostTableEntries;
  RendererChoice renderer = RendererChoice::automatic;
};

template <class Visitor>
void describe(Visitor& v, VolumeParams& p) {
  v.choice("mode", p.mode, kRayModeNames, {"how the samples along a ray become a colour", Tier::basic});
  v.field("first_hit_db", p.first_hit_db,
          {.unit = "dB",
           .min = -200,
           .max = 100,
           .text = "modes first hit, and volume and surface: the surface lies where Sv reaches this",
           .tier = Tier::basic});
  v.field("lighting", p.lighting, {.text = "light surfaces by the gradient of Sv in metres", .tier = Tier::basic});
  v.field("occlusion_m", p.occlusion_m,
          {.unit = "m",
           .min = 0,
           .max = 1000,
           .text = "lit surfaces are darker where others stand within this distance before them; 0 = nowhere"});
  v.field("depth_cue", p.depth_cue,
          {.text = "echoes fade into the background with their distance from the eye, as the lines round them do",
           .tier = Tier::basic});
  v.field("data", p.data, {.text = "show the data round the schools", .tier = Tier::basic, .flag = "masks-alone"});
  v.field("filtered", p.filtered,
          {.text = "show Sv after the median filter, without speckle; off = as recorded",
           .tier = Tier::basic,
           .flag = kNoFlag});
  v.field("context", p.context,
          {.text = "show the sector's frame, range rings, sea surface, ship, axes, scale bar and numbers of schools",
           .tier = Tier::basic});
  v.choice(
      "drop_lines", p.drop_lines, kDropLinesNames,
      {"schools with a line straight up to the sea surface and down to the seabed, where that is known", Tier::basic});
  v.field(
      "seabed", p.seabed,
      {.text = "show the seabed: of the depth chart where one is chosen, else the plane fitted to the ping's echoes",
       .tier = Tier::basic});
  v.field("current_arrows", p.current_arrows,
          {.text = "show the current below the ship as arrows by depth, where the recipe has water velocities",
           .tier = Tier::basic});
  v.field("slice_planes", p.slice_planes,
          {.text = "show where the slices from above and from the side lie", .tier = Tier::basic});
  v.choice("clip", p.clip, kVolumeClipNames,
           {"leave out the echoes on the viewer's side of a slice; schools stay whole", Tier::basic});
  v.field("earth_fixed", p.earth_fixed,
          {.text = "while pings pass the eye stands still on the earth; off = it sails with the ship",
           .tier = Tier::basic});
  v.field(
      "interpolated", p.interpolated,
      {.text = "while pings play the picture moves evenly from one to the next: Sv between them is interpolated, which "
               "the picture says; nothing is measured there, and the ping as measured is shown when playing stops",
       .tier = Tier::basic,
       .flag = kNoFlag});
  v.field(
      "ship_track", p.ship_track,
      {.text = "show the ship's track on the sea surface, paler where it has still to be sailed", .tier = Tier::basic});
  v.field("school_tracks", p.school_tracks,
          {.text = "show the track of each school: a line through its middles in all its pings", .tier = Tier::basic});
  v.field("trail_pings", p.trail_pings,
          {.unit = "pings",
           .min = 0,
           .max = 200,
           .text = "show where schools were on the earth in so many pings before, paler with age; 0 = not",
           .tier = Tier::basic});
  v.field("ship_length_m", p.ship_length_m, {.unit = "m", .min = 1, .max = 500, .text = "length of the drawn ship"});
  v.field(
      "moving_budget_ms", p.moving_budget_ms,
      {.unit = "ms", .min = 5, .max = 2000, .text = "what a picture may take while something moves", .flag = kNoFlag});
  v.field("frames", p.frames,
          {.unit = "1",
           .min = 0,
           .max = 1024,
           .text = "jittered pictures that are averaged: sampling quality; 0 = one plain picture"});
  v.field("table_entries", p.table_entries,
          {.unit = "1", .min = 2, .max = kMostTableEntries, .text = "steps of the transfer function's table"});
  v.choice("renderer", p.renderer, kRendererNames,
           "what draws: the graphics card (gl), the processor (cpu), or whichever is quicker (auto)");
}

}  // namespace sonar
