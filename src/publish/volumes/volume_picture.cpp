// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/volume_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "pipeline/stages/placements.h"
#include "pipeline/stages/voxel_statistics.h"
#include "publish/echograms/observation_echogram.h"
#include "publish/maps/chart_seabed.h"
#include "publish/movies/between_pings.h"
#include "publish/renderer_choice.h"
#include "publish/reports/sample_looks.h"
#include "publish/volumes/drawn_schools.h"
#include "publish/volumes/mask_silhouettes.h"
#include "publish/volumes/volume_figure.h"
#include "render/refinement.h"
#include "view/slices/slice.h"
#include "view/volume/earth_pose.h"

namespace sonar {
namespace {

/// Where the slices lie: as asked for, else through the largest school, else in the middle.
Result<void> place_slices(VolumeFigure& figure, const Sector& sector, const DrawnPing& ping,
                          const PictureOptions& options) {
  // Whether schools are shown or not.
  const auto school = middle_of_largest(chosen_layers(ping, options), sector.beams());
  figure.fan = options.fan.value_or(school ? school->fan : sector.fans() / 2);
  figure.beam = options.beam.value_or(school ? school->beam : sector.beams() / 2);
  if (auto there = check_slice(sector, {TopSlice{figure.fan}}); !there) return there;
  return check_slice(sector, {SideSlice{figure.beam}});
}

/// The selected school's outline is wider.
void take_masks(VolumeFigure& figure, const DrawnPing& ping, const PictureOptions& options) {
  figure.masks = mask_layers(ping, options);
  if (!options.display.masks) return;
  for (DrawnSchoolKey& school : school_keys(ping, options)) {
    figure.legend.emplace_back(school.colour, std::move(school.name));
    figure.names.push_back(std::to_string(school.id));
    if (school.id == options.selected_school) figure.masks[figure.names.size() - 1].selected = true;
  }
}

/// Tracks and trails as wide as the picture's lines.
void take_trails(VolumeFigure& figure, DrawnObservation& observation, const Sector& sector, std::int64_t ping,
                 const PictureOptions& options, const VolumePlace& place) {
  const TrailParams params = trail_params(options.volume);
  if (!params.any()) return;
  const TrailSubject subject = trail_subject(observation, options);
  figure.trails = std::make_shared<const std::vector<SceneLine>>(
      observation.trails().lines(sector, subject, ping, figure.navigation, params, scaled_theme(place)));
  figure.schools_tracked = !subject.schools.empty();
}

/// The options with the camera where it stands in the ping that is drawn, if it was named for another.
/// errors  usage: no such ping; mismatch: it is not known where one of them is on the earth
Result<PictureOptions> with_standing_eye(const DrawnObservation& observation, const PictureOptions& options,
                                         const VolumePlace& place) {
  const std::int64_t of = options.kind.volume.eye_ping;
  if (!options.volume.earth_fixed || of < 0) return options;
  if (of >= observation.pings()) {
    return fail(ErrorCode::usage, fmt::format("no ping {} for the eye in {}: it has pings 0 to {}", of,
                                              observation.name(), observation.pings() - 1));
  }
  const auto index = chosen_ping(observation, options);
  if (!index) return pass_on(index);
  if (*index == of) return options;  // there and back is not the same to the last bit
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  const auto camera = volume_camera(*sector, options, place.rays);
  if (!camera) return pass_on(camera);
  const auto& pings = observation.product().pings;
  const auto moved =
      standing_still(*camera, pings[static_cast<std::size_t>(of)], pings[static_cast<std::size_t>(*index)]);
  if (!moved) {
    return fail(
        ErrorCode::mismatch,
        fmt::format("an earth-fixed eye needs position and heading: pings {} and {} have not both", of, *index));
  }
  PictureOptions out = options;
  out.camera = *moved;
  out.kind.volume = CameraParams{};
  out.kind.volume.seconds = options.kind.volume.seconds;
  return out;
}

/// The ping asked for, and its schools.
/// place  of the volume in its picture: what is cut away depends on the camera
Result<VolumeFigure> prepare(DrawnObservation& observation, const PictureOptions& options, const VolumePlace& place,
                             Work& work) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto index = chosen_ping(observation, options);
  if (!index) return pass_on(index);
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  const auto ping = drawn_ping(observation, *index, options, work);
  if (!ping) return pass_on(ping);
  VolumeFigure out;
  take_masks(out, *ping, options);
  if (auto placed = place_slices(out, *sector, *ping, options); !placed) return pass_on(placed);
  out.refused = drawn_refused(observation, *sector, ping->ping_index, options);
  out.navigation = ping->navigation;
  out.moved = moves_places(observation.recipe(), out.navigation);
  out.currents = volume_currents(observation.recipe(), *sector, out.navigation, options.volume, options.units);
  take_trails(out, observation, *sector, ping->ping_index, options, place);
  out.samples = ping->staged != nullptr;
  out.searched = observation.has_product();
  out.title = observation.title();
  out.title_line =
      fmt::format("{}{}   ping {}", out.title, out.samples ? "" : " (masks alone: no raw files)", ping->ping_index);
  const double depth = out.navigation.transducer_depth_m;
  if (ping->staged) {
    const auto camera = volume_camera(*sector, options, place.rays);
    if (!camera) return pass_on(camera);
    const VolumeCut cut = volume_cut(*sector, options, *camera, out.fan, out.beam);
    out.volume = drawn_volume(*sector, *ping->staged, options, cut, depth);
    out.fitted = fitted_seabed(*ping->staged);
    if (options.display.shadow) {
      out.shadow_from = std::make_shared<const std::vector<int>>(
          shadow_from(*ping->heard, *sector, casting_shadow(*ping, options), observation.recipe().measure.extinction,
                      options.display.shadow_db));
    }
  } else {
    const Shape3 shape{sector->fans(), sector->beams(), sector->range().count};
    // Weakest of all: something for the masks to lie in, which is never shown itself.
    out.volume = std::make_shared<VolumeData>(VolumeData{*sector, Array3<std::int16_t>(shape, kMinCount), -depth});
  }
  return out;
}

Result<std::shared_ptr<const SeabedPatch>> seabed(const VolumeFigure& figure, const PictureOptions& options) {
  if (options.depth_raster.empty() || !options.volume.seabed) return std::shared_ptr<const SeabedPatch>{};
  const RangeAxis& range = figure.sector().range();
  return ChartSeabed().round(options.depth_raster, figure.navigation, range.range_m(range.count - 1));
}

Result<RayImage> refined(VolumeRenderer& renderer, const VolumeView& view, const PictureOptions& options, Work& work) {
  const std::string stage = fmt::format("drawing by {}", renderer.name());
  work.progress(stage, 0, std::max(options.volume.frames, 1));
  // One alone would stand beside the pixels' middles.
  if (options.volume.frames <= 1) return renderer.draw(view, {}, work);
  Refinement refinement(renderer, {.most_frames = options.volume.frames, .rest_budget_s = options.kind.volume.seconds});
  refinement.restart(view);
  for (;;) {
    auto frame = refinement.next(work);
    if (!frame) return pass_on(frame);
    if (frame->done) return std::move(frame->image);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    work.progress(stage, frame->averaged, options.volume.frames);
  }
}

Result<RayImage> traced_by(RendererChoice choice, const VolumeFigure& figure, const VolumeView& view,
                           const PictureOptions& options, Work& work) {
  const auto table = volume_table(options);
  if (!table) return pass_on(table);
  auto offscreen = offscreen_renderer(choice);
  if (!offscreen) return pass_on(offscreen);
  VolumeRenderer& renderer = *offscreen->renderer;
  if (auto set = renderer.set_volume(figure.volume); !set) return pass_on(set);
  if (auto set = renderer.set_transfer(*table); !set) return pass_on(set);
  if (!figure.outlined) {
    if (auto set = renderer.set_masks(figure.masks); !set) return pass_on(set);
    return refined(renderer, view, options, work);
  }
  const auto silhouettes = mask_silhouettes(renderer, figure.masks, view, work);
  if (!silhouettes) return pass_on(silhouettes);
  if (auto set = renderer.set_masks({}); !set) return pass_on(set);
  auto rays = refined(renderer, view, options, work);
  if (!rays) return rays;
  const Theme theme = theme_of(options);
  lay_outlines(*rays, figure.masks, *silhouettes, static_cast<int>(std::lround(1.5 * theme.line_px * options.scale)),
               theme);
  return rays;
}

/// A driver that gives up in the middle is not asked again, unless it alone was asked for.
Result<RayImage> traced(const VolumeFigure& figure, const VolumeView& view, const PictureOptions& options, Work& work) {
  auto rays = traced_by(options.volume.renderer, figure, view, options, work);
  if (rays || options.volume.renderer != RendererChoice::automatic) return rays;
  if (rays.error().code == ErrorCode::cancelled || rays.error().code == ErrorCode::bad_parameter) return rays;
  return traced_by(RendererChoice::cpu, figure, view, options, work);
}

}  // namespace

Result<PictureOptions> with_ping_to_see(DrawnObservation& observation, PictureOptions options, Work& work) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const bool surfaces = ends_at_surface(options.volume.mode) && options.volume.data;
  if (options.ping || !surfaces || strongest_schools_ping(observation, options)) return options;
  const auto echogram = observation_echogram(observation, options.volume.filtered, 0, work);
  if (!echogram) return pass_on(echogram);
  const auto ping =
      *echogram ? fullest_ping(**echogram, observation.product().pings, options.volume.first_hit_db) : std::nullopt;
  if (ping) options.ping = static_cast<int>(*ping);
  return options;
}

Result<FrameDescription> volume_frame(DrawnObservation& observation, const PictureOptions& as_asked, Work& work) {
  const auto place = volume_place(as_asked, as_asked.scale);
  if (!place) return pass_on(place);
  const auto seen = with_ping_to_see(observation, as_asked, work);
  if (!seen) return pass_on(seen);
  const PictureOptions& asked = *seen;
  const auto standing = with_standing_eye(observation, asked, *place);
  if (!standing) return pass_on(standing);
  const PictureOptions& options = *standing;
  auto figure = prepare(observation, options, *place, work);
  if (!figure) return pass_on(figure);
  auto patch = seabed(*figure, options);
  if (!patch) return pass_on(patch);
  figure->seabed = std::move(*patch);
  figure->outlined = wants_outlines(*figure, options);
  const auto camera = volume_camera(figure->sector(), options, place->rays);
  if (!camera) return pass_on(camera);
  const ContextPicture context = volume_context(*figure, options, *place, *camera, work);
  const VolumeView view = volume_view(*figure, options, *place, *camera, context);
  const auto rays = traced(*figure, view, options, work);
  if (!rays) return pass_on(rays);
  return volume_figure_frame(*figure, options, *place, view, context, *rays, work);
}

}  // namespace sonar
