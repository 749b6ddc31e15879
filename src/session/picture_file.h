// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "publish/picture_options.h"

namespace sonar {

enum class PlaneLies : std::uint8_t { horizontal, along_bearing, through_places, oblique };
inline constexpr std::array<std::string_view, 4> kPlaneLiesNames{"horizontal", "along_bearing", "through_places",
                                                                 "oblique"};

/// What is asked before a picture or a movie goes into a file; everything else is as the window shows it.
struct PictureFileParams {
  int width_px = 1600;
  int height_px = 1200;
  double scale = 1.0;
  double frame_s = 0.2;
  // slices
  double range_m = 200.0;
  PlaneLies plane = PlaneLies::horizontal;
  double depth_m = 50.0;
  double bearing_deg = 0.0;
  double from_bow_m = 0.0, from_starboard_m = 0.0, to_bow_m = 0.0, to_starboard_m = 300.0;
  double point_bow_m = 0.0, point_starboard_m = 0.0, point_down_m = 0.0;
  double normal_bow = 1.0, normal_starboard = 0.0, normal_down = 0.5;
  // volume
  bool camera_of_window = true;
  double ship_length_m = 60.0;
  int table_entries = kMostTableEntries;
  bool seabed = false;
  // propagation
  int neighbours = 2;
  bool side_view = false;
  // timeline
  bool whole_survey = false;
  bool along_log = false;
  bool maximum = false;
  // schools
  bool selected_school_alone = false;
};

template <class Visitor>
void describe(Visitor& v, PictureFileParams& p) {
  constexpr double kFar_m = 1e6;
  v.field("width_px", p.width_px, {.unit = "px", .min = 320, .max = 16384, .text = "width of the picture"});
  v.field("height_px", p.height_px, {.unit = "px", .min = 240, .max = 16384, .text = "height of the picture"});
  v.field("scale", p.scale,
          {.unit = "1", .min = 0.25, .max = 8, .text = "pixels of the file a pixel of the size: 2 for print"});
  v.field("frame_s", p.frame_s, {.unit = "s", .min = 0.02, .max = 60, .text = "how long a movie shows each picture"});
  v.field("range_m", p.range_m, {.unit = "m", .min = 0, .max = kFar_m, .text = "slant range of the shell"});
  v.choice("plane", p.plane, kPlaneLiesNames, "how the plane lies");
  v.field("depth_m", p.depth_m,
          {.unit = "m", .min = -kFar_m, .max = kFar_m, .text = "horizontal: depth below the sea surface"});
  v.field("bearing_deg", p.bearing_deg,
          {.unit = "deg", .min = -360, .max = 360, .text = "along bearing: vertical through the sonar, true bearing"});
  v.field("from_bow_m", p.from_bow_m,
          {.unit = "m", .min = -kFar_m, .max = kFar_m, .text = "through places: the first, towards the bow"});
  v.field("from_starboard_m", p.from_starboard_m,
          {.unit = "m", .min = -kFar_m, .max = kFar_m, .text = "through places: the first, towards starboard"});
  v.field("to_bow_m", p.to_bow_m,
          {.unit = "m", .min = -kFar_m, .max = kFar_m, .text = "through places: the second, towards the bow"});
  v.field("to_starboard_m", p.to_starboard_m,
          {.unit = "m", .min = -kFar_m, .max = kFar_m, .text = "through places: the second, towards starboard"});
  v.field("point_bow_m", p.point_bow_m,
          {.unit = "m", .min = -kFar_m, .max = kFar_m, .text = "oblique: a point of it, towards the bow"});
  v.field("point_starboard_m", p.point_starboard_m,
          {.unit = "m", .min = -kFar_m, .max = kFar_m, .text = "oblique: a point of it, towards starboard"});
  v.field("point_down_m", p.point_down_m,
          {.unit = "m", .min = -kFar_m, .max = kFar_m, .text = "oblique: a point of it, below the transducer"});
  v.field("normal_bow", p.normal_bow,
          {.unit = "1", .min = -1, .max = 1, .text = "oblique: its normal, towards the viewer: towards the bow"});
  v.field("normal_starboard", p.normal_starboard,
          {.unit = "1", .min = -1, .max = 1, .text = "oblique: its normal, towards starboard"});
  v.field("normal_down", p.normal_down, {.unit = "1", .min = -1, .max = 1, .text = "oblique: its normal, downwards"});
  v.field("camera_of_window", p.camera_of_window, {.text = "look from where the window does; off = an overview"});
  v.field("ship_length_m", p.ship_length_m, {.unit = "m", .min = 1, .max = 500, .text = "length of the drawn ship"});
  v.field("table_entries", p.table_entries,
          {.unit = "1", .min = 2, .max = kMostTableEntries, .text = "steps of the transfer function's table"});
  v.field("seabed", p.seabed, {.text = "draw the seabed of the depth chart; one must be chosen"});
  v.field("neighbours", p.neighbours, {.unit = "pings", .min = 0, .max = 100, .text = "pings before and after"});
  v.field("side_view", p.side_view, {.text = "masks from the side instead of from above"});
  v.field("whole_survey", p.whole_survey, {.text = "all observations, not the one on show alone"});
  v.field("along_log", p.along_log, {.text = "against the vessel's log instead of time"});
  v.field("maximum", p.maximum, {.text = "the maximum over beams instead of the mean"});
  v.field("selected_school_alone", p.selected_school_alone, {.text = "draw the selected school and no other"});
}

/// Which of them matter for a kind of picture, in the order in which they are asked for.
[[nodiscard]] std::vector<std::string> asked_for(PictureKind kind);
/// The same for a movie.
[[nodiscard]] std::vector<std::string> asked_for_movie(PictureKind kind);

/// Works them into options that show a picture as the window does.
/// errors  bad_parameter: a plane without direction, more pixels than a file may have
[[nodiscard]] Result<PictureOptions> with(const PictureFileParams& params, PictureKind kind, PictureOptions options);

}  // namespace sonar
