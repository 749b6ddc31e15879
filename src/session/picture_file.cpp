// SPDX-License-Identifier: Apache-2.0
#include "session/picture_file.h"

#include <fmt/format.h>

#include <utility>

namespace sonar {
namespace {

constexpr double kMostPixels = 64e6;

/// Empty where the numbers make no plane.
std::optional<PlaneChoice> plane_of(const PictureFileParams& p) {
  PlaneChoice plane;
  switch (p.plane) {
    case PlaneLies::horizontal:
      plane.depth_m = p.depth_m;
      return plane;
    case PlaneLies::along_bearing:
      plane.bearing_deg = p.bearing_deg;
      return plane;
    case PlaneLies::through_places:
      plane.through = {p.from_bow_m, p.from_starboard_m, p.to_bow_m, p.to_starboard_m};
      if (p.from_bow_m == p.to_bow_m && p.from_starboard_m == p.to_starboard_m) return std::nullopt;
      return plane;
    case PlaneLies::oblique:
      plane.oblique = {p.point_bow_m, p.point_starboard_m, p.point_down_m,
                       p.normal_bow,  p.normal_starboard,  p.normal_down};
      if (p.normal_bow == 0.0 && p.normal_starboard == 0.0 && p.normal_down == 0.0) return std::nullopt;
      return plane;
  }
  return std::nullopt;
}

std::vector<std::string> of_kind(PictureKind kind) {
  switch (kind) {
    case PictureKind::slice_range:
      return {"range_m"};
    case PictureKind::slice_plane:
      return {"plane",      "depth_m",          "bearing_deg", "from_bow_m",        "from_starboard_m",
              "to_bow_m",   "to_starboard_m",   "point_bow_m", "point_starboard_m", "point_down_m",
              "normal_bow", "normal_starboard", "normal_down"};
    case PictureKind::volume:
      return {"camera_of_window", "seabed", "ship_length_m", "table_entries"};
    case PictureKind::propagation:
      return {"neighbours", "side_view"};
    case PictureKind::timeline:
      return {"whole_survey", "along_log", "maximum"};
    default:
      return {};
  }
}

}  // namespace

std::vector<std::string> asked_for(PictureKind kind) {
  std::vector<std::string> names{"width_px", "height_px", "scale"};
  for (std::string& name : of_kind(kind)) names.push_back(std::move(name));
  names.emplace_back("selected_school_alone");
  return names;
}

std::vector<std::string> asked_for_movie(PictureKind kind) {
  std::vector<std::string> names = asked_for(kind);
  names.insert(names.begin() + 3, "frame_s");
  return names;
}

Result<PictureOptions> with(const PictureFileParams& params, PictureKind kind, PictureOptions options) {
  options.size = {params.width_px, params.height_px};
  const double pixels = static_cast<double>(params.width_px) * params.height_px * params.scale * params.scale;
  if (pixels > kMostPixels) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("{} x {} at scale {:g} makes {:.0f} million pixels; expected "
                            "{:.0f} at most",
                            params.width_px, params.height_px, params.scale, pixels / 1e6, kMostPixels / 1e6));
  }
  if (kind == PictureKind::slice_range) options.range_m = params.range_m;
  if (kind == PictureKind::slice_plane) {
    auto plane = plane_of(params);
    if (!plane) return fail(ErrorCode::bad_parameter, "these numbers make no plane: expected two places or a normal");
    options.plane = *plane;
  }
  if (kind == PictureKind::volume) {
    if (!params.camera_of_window) options.camera.reset();
    options.ship_length_m = params.ship_length_m;
    options.table_entries = params.table_entries;
  }
  if (kind == PictureKind::volume && !params.seabed) options.depth_raster.clear();
  options.neighbours = params.neighbours;
  options.side_view = params.side_view;
  options.whole_survey = params.whole_survey;
  options.along_log = params.along_log;
  options.maximum = params.maximum;
  return options;
}

}  // namespace sonar
