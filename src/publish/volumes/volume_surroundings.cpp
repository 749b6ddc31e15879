// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/stages/current_column.h"
#include "publish/volumes/volume_figure.h"
#include "view/volume/earth_pose.h"

namespace sonar {

VolumeCut volume_cut(const Sector& sector, const PictureOptions& options, const Camera& camera, int fan, int beam) {
  const VolumeClip clip = options.volume.clip;
  const bool top = clip == VolumeClip::top_slice || clip == VolumeClip::both_slices;
  const bool side = clip == VolumeClip::side_slice || clip == VolumeClip::both_slices;
  return cut_before(sector, camera.eye, top ? std::optional(fan) : std::nullopt,
                    side ? std::optional(beam) : std::nullopt);
}

std::optional<FittedSeabed> fitted_seabed(const StagedPing& staged) {
  const auto& found = staged.seabed;
  if (!found.found) return std::nullopt;
  return FittedSeabed{found.offset_m, found.slope_x, found.slope_y, found.min_x, found.max_x, found.min_y, found.max_y};
}

CurrentColumn volume_currents(const Recipe& recipe, const Sector& sector, const PingNavigation& navigation,
                              const VolumeParams& params, const Units& units) {
  if (!params.current_arrows || recipe.current_profiles.empty() || !on_earth(navigation)) return {};
  const std::vector<double> depths_m = current_depths(sector, navigation.transducer_depth_m, units);
  return {current_column(recipe, navigation, depths_m), longest_arrow_mps(recipe.current_profiles)};
}

namespace {

/// z of the seabed under a place; NaN where it is not known.
double seabed_z_m(const VolumeFigure& figure, const Point<Sonar>& place) {
  if (figure.seabed) {
    const double depth_m = depth_under(*figure.seabed, place.x, place.y);
    if (depth_m > 0.0) return depth_m - figure.navigation.transducer_depth_m;
  }
  if (!figure.fitted) return std::numeric_limits<double>::quiet_NaN();
  const FittedSeabed& bed = *figure.fitted;
  const bool seen = place.x >= bed.min_x && place.x <= bed.max_x && place.y >= bed.min_y && place.y <= bed.max_y;
  return seen ? bed.z_at(place.x, place.y) : std::numeric_limits<double>::quiet_NaN();
}

std::vector<SchoolPlace> school_places(const VolumeFigure& figure, DropLines drop_lines, const Unit& unit) {
  std::vector<SchoolPlace> out;
  bool named = false;  // of several that are selected the first alone is always named
  for (std::size_t i = 0; i < figure.masks.size() && i < figure.names.size(); ++i) {
    const MaskLayer& layer = figure.masks[i];
    if (figure.names[i].empty() || !layer.mask) continue;
    auto place = school_place(figure.sector(), *layer.mask);
    if (!place) continue;
    const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(std::lround(layer.rgb[k] * 255.0F)); };
    place->colour = {byte(0), byte(1), byte(2), 255};
    place->selected = layer.selected && !std::exchange(named, named || layer.selected);
    place->name = figure.names[i];
    place->drop_line = drop_lines == DropLines::all || (drop_lines == DropLines::selected && layer.selected);
    if (place->drop_line) {
      place->seabed_z_m = seabed_z_m(figure, place->middle);
      for (Point<Sonar>& p : place->footprint) p.z = seabed_z_m(figure, p);
    }
    if (place->selected) {
      const double depth_m = place->middle.z + figure.navigation.transducer_depth_m;
      place->name += fmt::format(": {} deep", quantity_text(depth_m, 0, unit));
    }
    out.push_back(std::move(*place));
  }
  return out;
}

}  // namespace

ContextParams volume_surroundings(const VolumeFigure& figure, const PictureOptions& options) {
  const PingNavigation& navigation = figure.navigation;
  ContextParams params;
  params.sector_frame = params.range_rings = params.sea_surface = params.ship = params.depth_axis =
      options.volume.context;
  params.units = options.units;
  params.ship_length_m = options.volume.ship_length_m;
  params.transducer_depth_m = navigation.transducer_depth_m;
  if (const double heading = navigation.heading_deg; !std::isnan(heading)) params.heading_deg = heading;
  if (!options.volume.context) return params;
  if (options.volume.seabed && !figure.seabed) params.fitted_seabed = figure.fitted;
  if (options.volume.slice_planes) {
    params.top_fan = figure.fan;
    params.side_beam = figure.beam;
  }
  params.schools = school_places(figure, options.volume.drop_lines, options.units.length());
  params.currents = figure.currents;
  params.shadow_from = figure.shadow_from;
  params.trails = figure.trails;
  return params;
}

ContextPicture volume_context(const VolumeFigure& figure, const PictureOptions& options, const VolumePlace& place,
                              const Camera& camera, Work& work) {
  const ContextParams params = volume_surroundings(figure, options);
  const Theme theme = scaled_theme(place);
  const auto seabed = figure.seabed ? std::optional(*figure.seabed) : std::nullopt;
  return draw_context(context_scene(figure.sector(), params, theme, seabed), camera, place.rays,
                      depth_cue(figure.sector(), camera, theme.plot), -params.transducer_depth_m, work);
}

}  // namespace sonar
