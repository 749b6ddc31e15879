// SPDX-License-Identifier: Apache-2.0
#include "publish/volume_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/units.h"
#include "geo/geodesic.h"
#include "io/depth_raster.h"
#include "publish/between_pings.h"
#include "publish/drawn_schools.h"
#include "publish/mask_silhouettes.h"
#include "publish/renderer_choice.h"
#include "publish/volume_figure.h"
#include "render/refinement.h"

namespace sonar {
namespace {

constexpr int kPatchNodes = 121;

/// The ping asked for, and its schools.
Result<VolumeFigure> prepare(DrawnObservation& observation, const PictureOptions& options, Work& work) {
  if (auto known = require_schools(observation, options); !known) return pass_on(known);
  const auto index = chosen_ping(observation, options);
  if (!index) return pass_on(index);
  const auto sector = observation.sector();
  if (!sector) return pass_on(sector);
  const auto ping = drawn_ping(observation, *index, options, work);
  if (!ping) return pass_on(ping);
  VolumeFigure out;
  out.masks = mask_layers(*ping, options);
  for (SchoolKey& school : school_keys(*ping, options)) {
    out.legend.emplace_back(school.colour, std::move(school.name));
  }
  out.refused = drawn_refused(observation, *sector, ping->ping_index, options);
  out.navigation = ping->navigation;
  out.samples = ping->staged != nullptr;
  out.searched = observation.has_product();
  out.title = observation.title();
  out.title_line =
      fmt::format("{}{}   ping {}", out.title, out.samples ? "" : " (masks alone: no raw files)", ping->ping_index);
  const double depth = out.navigation.transducer_depth_m;
  if (ping->staged) {
    out.volume = drawn_volume(*sector, *ping->staged, options, depth);
  } else {
    const Shape3 shape{sector->fans(), sector->beams(), sector->range().count};
    // Weakest of all: something for the masks to lie in, which is never shown itself.
    out.volume = std::make_shared<VolumeData>(VolumeData{*sector, Array3<std::int16_t>(shape, kMinCount), -depth});
  }
  return out;
}

Result<std::optional<SeabedPatch>> seabed(const VolumeFigure& figure, const PictureOptions& options) {
  if (options.depth_raster.empty()) return std::optional<SeabedPatch>{};
  const PingNavigation& navigation = figure.navigation;
  if (!navigation.has_position()) {
    return fail(ErrorCode::mismatch, "no seabed: the ping has no position", {options.depth_raster.string()});
  }
  const RangeAxis& range = figure.sector().range();
  const double reach = 1.1 * range.range_m(range.count - 1);
  const Geographic ship = navigation.transducer;
  const auto extent = extent_of(std::span(&ship, 1));
  const auto grid = read_depth_raster(options.depth_raster, widened(*extent, 1.5 * reach));
  if (!grid) return pass_on(grid);
  auto patch = seabed_patch(*grid, navigation.placement(), reach);
  if (!patch) return pass_on(patch);
  return std::optional(std::move(*patch));
}

Result<RayImage> refined(VolumeRenderer& renderer, const VolumeView& view, const PictureOptions& options, Work& work) {
  if (options.volume.frames <= 0) return renderer.draw(view, {}, work);
  Refinement refinement(renderer, {.most_frames = options.volume.frames, .rest_budget_s = options.kind.volume.seconds});
  refinement.restart(view);
  for (;;) {
    auto frame = refinement.next(work);
    if (!frame) return pass_on(frame);
    if (frame->done) return std::move(frame->image);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    work.progress("drawing", frame->averaged, options.volume.frames);
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
               theme.text);
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

Result<SeabedPatch> seabed_patch(const DepthGrid& grid, const Placement& ship, double reach_m) {
  SeabedPatch patch{kPatchNodes, kPatchNodes, -reach_m, -reach_m, 2.0 * reach_m / (kPatchNodes - 1), {}};
  bool known = false;
  for (int iy = 0; iy < patch.ny; ++iy) {
    for (int ix = 0; ix < patch.nx; ++ix) {
      const Point<Sonar> at{patch.first_x_m + ix * patch.spacing_m, patch.first_y_m + iy * patch.spacing_m, 0.0};
      const double depth = grid.depth_at(to_geographic(to_enu(at, ship.heading_rad), ship.transducer));
      known = known || !std::isnan(depth);
      patch.depth_m.push_back(static_cast<float>(depth));
    }
  }
  if (!known) return fail(ErrorCode::mismatch, "no depth is known round the ship", {grid.source});
  return patch;
}

Result<FrameDescription> volume_frame(DrawnObservation& observation, const PictureOptions& options, Work& work) {
  auto figure = prepare(observation, options, work);
  if (!figure) return pass_on(figure);
  const auto place = volume_place(options, options.scale);
  if (!place) return pass_on(place);
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
